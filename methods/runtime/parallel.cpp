#include "methods/runtime/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <unistd.h>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

constexpr std::size_t most_threads = 1024;

/// Threads that wait for work.
class WorkerTeam {
 public:
  /// `helpers` threads besides the caller's.
  explicit WorkerTeam(std::size_t helpers) {
    for (std::size_t i = 0; i < helpers; ++i) {
      threads_.emplace_back([this](const std::stop_token& stop) { serve(stop); });
    }
  }
  WorkerTeam(const WorkerTeam&) = delete;
  WorkerTeam& operator=(const WorkerTeam&) = delete;
  WorkerTeam(WorkerTeam&&) = delete;
  WorkerTeam& operator=(WorkerTeam&&) = delete;
  ~WorkerTeam() = default;  // the threads are asked to stop, and waited for

  [[nodiscard]] std::size_t helpers() const noexcept { return threads_.size(); }

  void run(std::size_t parts, const PartWork& work) {
    {
      const std::lock_guard lock(mutex_);
      work_ = &work;
      parts_ = parts;
      next_ = 0;
      busy_ = threads_.size();
      error_ = nullptr;
      ++call_;
    }
    begun_.notify_all();
    take_parts();
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void serve(const std::stop_token& stop) {
    std::size_t seen = 0;
    std::unique_lock lock(mutex_);
    while (begun_.wait(lock, stop, [&] { return call_ != seen; })) {
      seen = call_;
      lock.unlock();
      take_parts();
      lock.lock();
      if (--busy_ == 0) done_.notify_one();
    }
  }

  void take_parts() {
    for (std::size_t part = next_++; part < parts_; part = next_++) {
      try {
        (*work_)(part);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
    }
  }

  std::mutex mutex_;
  std::condition_variable_any begun_;
  std::condition_variable done_;
  const PartWork* work_ = nullptr;
  std::size_t parts_ = 0;
  std::atomic<std::size_t> next_{0};
  std::size_t busy_ = 0;
  std::size_t call_ = 0;
  std::exception_ptr error_;
  std::vector<std::jthread> threads_;  // last: they use the rest
};

std::size_t count_from_environment() {
  const char* wanted = std::getenv("DMOCBENCH_THREADS");  // NOLINT(concurrency-mt-unsafe): only read
  if (wanted == nullptr) return std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, most_threads);
  const std::string_view text(wanted);
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 1 || count > most_threads) {
    throw Error("DMOCBENCH_THREADS=" + std::string(text) + " is no number of threads; give one from 1 to 1024");
  }
  return count;
}

std::atomic<std::size_t>& count_that_was_set() {
  static std::atomic<std::size_t> count{0};  // 0 until it is
  return count;
}

/// The team of this process. A process that was forked has none of its parent's threads, and must not even touch what
/// they were made of: it gets a team of its own, and the parent's is left where it is.
struct Teams {
  std::mutex in_use;
  std::unique_ptr<WorkerTeam> team;
  pid_t process = 0;

  WorkerTeam& of_size(std::size_t helpers) {
    if (process != getpid()) {
      static_cast<void>(team.release());  // NOLINT(bugprone-unused-return-value): see above
      process = getpid();
    }
    if (!team || team->helpers() != helpers) team = std::make_unique<WorkerTeam>(helpers);
    return *team;
  }
};

Teams& teams() {
  // Never destroyed: at the end of a child that made no team the parent's would be, and wait for threads of another
  // process.
  static auto* const all = new Teams;  // NOLINT(cppcoreguidelines-owning-memory)
  return *all;
}

/// All parts, one after the other.
void do_all(std::size_t parts, const PartWork& work) {
  std::exception_ptr error;
  for (std::size_t part = 0; part < parts; ++part) {
    try {
      work(part);
    } catch (...) {
      if (!error) error = std::current_exception();
    }
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace

std::size_t thread_count() {
  const std::size_t set = count_that_was_set();
  static const std::size_t from_environment = count_from_environment();
  return set > 0 ? set : from_environment;
}

void set_thread_count(std::size_t count) {
  if (count < 1 || count > most_threads) {
    throw Error("the number of threads must be from 1 to 1024, not " + std::to_string(count));
  }
  count_that_was_set() = count;
}

std::size_t part_count(std::size_t intervals, std::size_t per_part) noexcept {
  return std::clamp<std::size_t>(intervals / per_part, 1, most_parts);
}

std::size_t begin_of_part(std::size_t part, std::size_t parts, std::size_t count, std::size_t unit) noexcept {
  return part == parts ? count : count / unit * part / parts * unit;
}

void for_each_part(std::size_t parts, const PartWork& work) {
  thread_local bool is_inside = false;
  const std::size_t helpers = parts > 1 && !is_inside ? thread_count() - 1 : 0;
  if (helpers == 0) {
    do_all(parts, work);
    return;
  }
  // A fork while another thread held the lock would leave it locked for ever; but nothing forks then: the processes of
  // an experiment are made by a thread that solves nothing itself.
  std::unique_lock lock(teams().in_use, std::defer_lock);
  if (!lock.try_lock()) {
    do_all(parts, work);
    return;
  }
  is_inside = true;
  const auto leave = std::unique_ptr<bool, void (*)(bool*)>(&is_inside, [](bool* inside) { *inside = false; });
  teams().of_size(helpers).run(parts, work);
}

}  // namespace dmocbench
