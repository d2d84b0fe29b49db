#include "methods/runtime/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

#include "methods/error.hpp"
#include "methods/runtime/parsed.hpp"

namespace dmocbench {

namespace {

constexpr std::size_t most_threads = 1024;

/// The parts of one call.
class Job {
 public:
  Job(std::size_t parts, const PartWork& work) : parts_(parts), work_(work) {}

  /// Does parts until none is left.
  void take_parts() {
    for (std::size_t part = next_++; part < parts_; part = next_++) {
      try {
        work_(part);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
    }
  }

  /// What the first part that threw has thrown; to be asked for when all have ended.
  [[nodiscard]] const std::exception_ptr& error() const noexcept { return error_; }

 private:
  std::size_t parts_;
  const PartWork& work_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::exception_ptr error_;
};

/// Threads that wait for work.
class WorkerTeam {
 public:
  /// `helpers` threads besides the caller's.
  explicit WorkerTeam(std::size_t helpers) {
    for (std::size_t i = 0; i < helpers; ++i) {
      threads_.emplace_back([this](const std::stop_token& stop) { serve(stop); });
    }
  }

  [[nodiscard]] std::size_t helpers() const noexcept { return threads_.size(); }

  void run(Job& job) {
    {
      const std::lock_guard lock(mutex_);
      job_ = &job;
      busy_ = threads_.size();
      ++call_;
    }
    begun_.notify_all();
    job.take_parts();
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
  }

 private:
  void serve(const std::stop_token& stop) {
    std::size_t seen = 0;
    std::unique_lock lock(mutex_);
    while (begun_.wait(lock, stop, [&] { return call_ != seen; })) {
      seen = call_;
      lock.unlock();
      job_->take_parts();
      lock.lock();
      if (--busy_ == 0) done_.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable_any begun_;
  std::condition_variable done_;
  Job* job_ = nullptr;
  std::size_t busy_ = 0;
  std::size_t call_ = 0;
  std::vector<std::jthread> threads_;  // last: they use the rest, and are waited for before it goes
};

std::size_t count_from_environment() {
  const char* wanted = std::getenv("DMOCBENCH_THREADS");  // NOLINT(concurrency-mt-unsafe): only read
  if (wanted == nullptr) return std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, most_threads);
  const std::size_t count = parsed<std::size_t>(wanted).value_or(0);
  if (count < 1 || count > most_threads) {
    throw Error("DMOCBENCH_THREADS=" + std::string(wanted) + " is no number of threads; give one from 1 to 1024");
  }
  return count;
}

std::atomic<std::size_t> count_that_was_set{0};  // 0 until it is

std::mutex team_is_in_use;

/// The team of this process. A process that was forked has none of its parent's threads, and must not even touch what
/// they were made of: it gets a team of its own, and the parent's is left where it is. No team is destroyed at the end:
/// a child that made none would wait for threads of another process.
WorkerTeam& team_of(std::size_t helpers) {
  static WorkerTeam* team = nullptr;
  static pid_t process = 0;
  const bool is_ours = process == getpid();
  if (is_ours && team->helpers() == helpers) return *team;
  auto made = std::make_unique<WorkerTeam>(helpers);
  if (is_ours) delete team;
  team = made.release();
  process = getpid();
  return *team;
}

}  // namespace

std::size_t thread_count() {
  const std::size_t set = count_that_was_set;
  static const std::size_t from_environment = count_from_environment();
  return set > 0 ? set : from_environment;
}

void set_thread_count(std::size_t count) {
  if (count < 1 || count > most_threads) {
    throw Error("the number of threads must be from 1 to 1024, not " + std::to_string(count));
  }
  count_that_was_set = count;
}

std::size_t part_count(std::size_t intervals, std::size_t per_part) noexcept {
  return std::clamp<std::size_t>(intervals / per_part, 1, most_parts);
}

std::size_t begin_of_part(std::size_t part, std::size_t parts, std::size_t count, std::size_t unit) noexcept {
  return part == parts ? count : count / unit * part / parts * unit;
}

void for_each_part(std::size_t parts, const PartWork& work) {
  if (parts == 1) return work(0);  // most vectors are short
  thread_local bool is_inside = false;
  Job job(parts, work);
  const std::size_t helpers = parts > 1 && !is_inside ? thread_count() - 1 : 0;
  // A fork while another thread held the lock would leave it locked for ever; but nothing forks then: the processes of
  // an experiment are made by a thread that solves nothing itself.
  std::unique_lock lock(team_is_in_use, std::defer_lock);
  if (helpers > 0 && lock.try_lock()) {
    WorkerTeam& team = team_of(helpers);
    is_inside = true;
    team.run(job);
    is_inside = false;
  } else {
    job.take_parts();
  }
  if (job.error()) std::rethrow_exception(job.error());
}

}  // namespace dmocbench
