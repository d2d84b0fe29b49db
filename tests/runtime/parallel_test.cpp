#include "methods/runtime/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "methods/error.hpp"
#include "tests/support/restored_settings.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using tests::Threads;

constexpr std::array<std::size_t, 4> thread_counts{1, 2, 3, 8};

/// How often each part was done.
class Tally {
 public:
  explicit Tally(std::size_t parts) : times_(parts) {}
  void count(std::size_t part) { ++times_.at(part); }
  [[nodiscard]] bool is_once_each() const {
    return std::ranges::all_of(times_, [](const auto& times) { return times == 1; });
  }

 private:
  std::vector<std::atomic<int>> times_;
};

/// Lets a number of callers pass once all of them are there. Nobody waits for ever.
class Meeting {
 public:
  explicit Meeting(int expected) : expected_(expected) {}
  /// False if the others did not come.
  bool attend() {
    std::unique_lock lock(mutex_);
    ++present_;
    changed_.notify_all();
    constexpr std::chrono::seconds patience(20);
    return changed_.wait_for(lock, patience, [&] { return present_ >= expected_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int expected_;
  int present_ = 0;
};

TEST(Parallel, DoesEveryPartExactlyOnce) {
  for (const std::size_t threads : thread_counts) {
    const Threads there(threads);
    for (const std::size_t parts : {0U, 1U, 2U, 3U, 7U, 64U, 1000U}) {
      for (int repetition = 0; repetition < 20; ++repetition) {
        Tally tally(parts);
        for_each_part(parts, [&](std::size_t part) { tally.count(part); });
        ASSERT_TRUE(tally.is_once_each()) << threads << " threads, " << parts << " parts";
      }
    }
  }
}

TEST(Parallel, WorksOnAsManyPartsAtOnceAsThereAreThreads) {
  for (const int threads : {2, 3}) {
    const Threads there(static_cast<std::size_t>(threads));
    Meeting meeting(threads);
    std::atomic<int> met = 0;
    for_each_part(static_cast<std::size_t>(threads), [&](std::size_t) { met += meeting.attend() ? 1 : 0; });
    EXPECT_EQ(met, threads);
  }
}

TEST(Parallel, HandsAnExceptionOnOnceAllPartsHaveEnded) {
  for (const std::size_t threads : thread_counts) {
    const Threads there(threads);
    for (const std::size_t thrower : {0U, 5U, 15U}) {
      SCOPED_TRACE(std::to_string(threads) + " threads, part " + std::to_string(thrower));
      constexpr std::size_t parts = 16;
      Tally tally(parts);
      try {
        for_each_part(parts, [&](std::size_t part) {
          tally.count(part);
          if (part == thrower) throw std::runtime_error("part " + std::to_string(part));
        });
        FAIL() << "no exception";
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), "part " + std::to_string(thrower));
      }
      EXPECT_TRUE(tally.is_once_each());
    }
  }
}

TEST(Parallel, CanBeUsedAgainAfterEveryPartHasThrown) {
  for (const std::size_t threads : thread_counts) {
    const Threads there(threads);
    constexpr std::size_t parts = 16;
    EXPECT_THROW(for_each_part(parts, [](std::size_t) { throw std::runtime_error("all"); }), std::runtime_error);
    Tally tally(parts);
    EXPECT_NO_THROW(for_each_part(parts, [&](std::size_t part) { tally.count(part); }));
    EXPECT_TRUE(tally.is_once_each());
  }
}

TEST(Parallel, DoesAllPartsOfACallFromInsideAPart) {
  for (const std::size_t threads : thread_counts) {
    const Threads there(threads);
    constexpr std::size_t outer = 6;
    constexpr std::size_t inner = 9;
    Tally tally(outer * inner);
    for_each_part(outer,
                  [&](std::size_t i) { for_each_part(inner, [&, i](std::size_t j) { tally.count(i * inner + j); }); });
    EXPECT_TRUE(tally.is_once_each()) << threads << " threads";
    Tally after(outer);
    for_each_part(outer, [&](std::size_t part) { after.count(part); });
    EXPECT_TRUE(after.is_once_each()) << threads << " threads";
  }
}

TEST(Parallel, DoesAllPartsOfTwoCallsAtOnce) {
  const Threads there(2);
  constexpr std::size_t parts = 8;
  Tally of_one(parts);
  Tally of_other(parts);
  Meeting meeting(2);  // both callers are inside a part before either goes on
  std::atomic<int> met = 0;
  const auto call = [&](Tally& tally) {
    for_each_part(parts, [&](std::size_t part) {
      if (part == 0) met += meeting.attend() ? 1 : 0;
      tally.count(part);
    });
  };
  std::thread other([&] { call(of_other); });
  call(of_one);
  other.join();
  EXPECT_EQ(met, 2);
  EXPECT_TRUE(of_one.is_once_each());
  EXPECT_TRUE(of_other.is_once_each());
}

TEST(Parallel, DoesAllPartsOfManyCallsFromManyThreads) {
  const Threads there(3);
  constexpr std::size_t parts = 5;
  std::atomic<int> wrong = 0;
  const auto call = [&] {
    for (int repetition = 0; repetition < 200; ++repetition) {
      Tally tally(parts);
      for_each_part(parts, [&](std::size_t part) { tally.count(part); });
      wrong += tally.is_once_each() ? 0 : 1;
    }
  };
  std::array<std::thread, 4> callers;
  for (std::thread& caller : callers) caller = std::thread(call);
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(wrong, 0);
}

TEST(Parallel, RefusesNumbersOfThreadsThatAreNone) {
  const Threads there(2);
  for (const std::size_t count : {std::size_t{0}, std::size_t{1025}, static_cast<std::size_t>(-1)}) {
    tests::expect_error_naming({"1024", std::to_string(count)}, [&] { set_thread_count(count); });
    EXPECT_EQ(thread_count(), 2U);
  }
  for (const std::size_t count : {1U, 1024U}) {
    EXPECT_NO_THROW(set_thread_count(count));
    EXPECT_EQ(thread_count(), count);
  }
}

TEST(Parallel, CoversEverythingByPartsThatBeginAtMultiplesOfTheUnit) {
  for (const std::size_t unit : {1U, 8U, 64U}) {
    for (const std::size_t count : {1U, 7U, 8U, 63U, 64U, 65U, 1000U, 12289U, 20000U, 262144U + 37U}) {
      for (const std::size_t parts : {1U, 2U, 3U, 4U, 61U, 64U}) {
        SCOPED_TRACE(std::to_string(count) + " by " + std::to_string(unit) + " in " + std::to_string(parts));
        EXPECT_EQ(begin_of_part(0, parts, count, unit), 0U);
        EXPECT_EQ(begin_of_part(parts, parts, count, unit), count);
        for (std::size_t part = 0; part < parts; ++part) {
          EXPECT_LE(begin_of_part(part, parts, count, unit), begin_of_part(part + 1, parts, count, unit));
          EXPECT_EQ(begin_of_part(part, parts, count, unit) % unit, 0U);
        }
      }
    }
  }
}

TEST(Parallel, CutsIntoAsManyPartsWhateverTheNumberOfThreads) {
  for (const std::size_t count : {1U, 4095U, 4096U, 8191U, 8192U, 20000U, 262144U, 1U << 24U}) {
    std::vector<std::size_t> parts;
    for (const std::size_t threads : thread_counts) {
      const Threads there(threads);
      parts.push_back(part_count(count));
      EXPECT_GE(parts.back(), 1U);
      EXPECT_LE(parts.back(), std::max<std::size_t>(1, count / intervals_per_part));
      EXPECT_EQ(parts.back(), parts.front());
    }
  }
  EXPECT_EQ(part_count(0), 1U);
  EXPECT_EQ(part_count(20000), 4U);
  EXPECT_EQ(part_count(100, 10), 10U);
}

/// How a child ends that does something; killed by a signal if it does not end by itself.
int end_of_child(const std::function<void()>& work) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    constexpr unsigned seconds = 20;
    alarm(seconds);
    work();
    _exit(1);  // it should have ended
  }
  int state = 0;
  if (child < 0 || waitpid(child, &state, 0) != child) return -1;
  return state;
}

bool all_parts_are_done() {
  Tally tally(16);
  for_each_part(16, [&](std::size_t part) { tally.count(part); });
  return tally.is_once_each();
}

/// ThreadSanitizer allows no threads in a child of a program that has some.
#ifdef __SANITIZE_THREAD__
constexpr bool children_may_have_threads = false;
#else
constexpr bool children_may_have_threads = true;
#endif

TEST(Parallel, CanBeUsedByAChildOfAProcessThatHasUsedIt) {
  if (!children_may_have_threads) GTEST_SKIP();
  for (const std::size_t threads : {2U, 3U}) {
    const Threads there(threads);
    ASSERT_TRUE(all_parts_are_done());
    const int end = end_of_child([] {
      set_thread_count(2);
      Meeting meeting(2);
      std::atomic<int> met = 0;
      for_each_part(2, [&](std::size_t) { met += meeting.attend() ? 1 : 0; });
      _exit(met == 2 && all_parts_are_done() ? 0 : 2);
    });
    EXPECT_TRUE(WIFEXITED(end) && WEXITSTATUS(end) == 0) << "ended with " << end;
    EXPECT_TRUE(all_parts_are_done());
  }
}

TEST(Parallel, LetsAChildExitThatHasNotUsedIt) {
  const Threads there(3);
  ASSERT_TRUE(all_parts_are_done());
  const int end = end_of_child([] { std::exit(0); });  // NOLINT(concurrency-mt-unsafe): one thread is left
  EXPECT_TRUE(WIFEXITED(end) && WEXITSTATUS(end) == 0) << "ended with " << end;
}

/// Reads the number of threads of a process that begins now, and ends it with 0, or with 3 and the sentence of the
/// error.
void read_number_of_threads(const char* text) {
  setenv("DMOCBENCH_THREADS", text, 1);  // NOLINT(concurrency-mt-unsafe): nothing else runs yet
  try {
    std::cerr << "threads: " << thread_count() << '\n';
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    std::exit(3);  // NOLINT(concurrency-mt-unsafe)
  }
  std::exit(0);  // NOLINT(concurrency-mt-unsafe)
}

TEST(ParallelDeathTest, TakesTheNumberOfThreadsFromTheEnvironment) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process of its own each time
  for (const char* text : {"1", "2", "1024"}) {
    EXPECT_EXIT(read_number_of_threads(text), testing::ExitedWithCode(0), "threads: " + std::string(text));
  }
}

TEST(ParallelDeathTest, RefusesAnEnvironmentWithoutANumberOfThreads) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (const char* text : {"", "0", "1025", "-1", "two", "2 ", " 2", "2.0", "2x", "99999999999999999999999"}) {
    EXPECT_EXIT(read_number_of_threads(text), testing::ExitedWithCode(3), "DMOCBENCH_THREADS=" + std::string(text))
        << '"' << text << '"';
  }
}

}  // namespace
}  // namespace dmocbench
