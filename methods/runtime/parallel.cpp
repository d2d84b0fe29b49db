#include "methods/runtime/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

#include "methods/error.hpp"
#include "methods/runtime/numbers_in_text.hpp"

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

  /// The first exception of any part; read it after all have ended.
  [[nodiscard]] const std::exception_ptr& error() const noexcept { return error_; }

 private:
  std::size_t parts_;
  const PartWork& work_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::exception_ptr error_;
};

/// Yields the processor, about ten microseconds in all, until `holds`: a thread that sleeps needs as long to wake.
/// False if it does not hold by then.
template <class Condition>
bool holds_soon(const Condition& holds) {
  constexpr int most_yields = 100;
  for (int i = 0; i < most_yields; ++i) {
    if (holds()) return true;
    std::this_thread::yield();
  }
  return holds();
}

/// Threads that wait for work. A job is open while parts of it may be left. A thread that comes later, because it slept
/// or had no processor, finds the job closed and is not waited for.
class WorkerTeam {
 public:
  /// `helpers` threads besides the caller's.
  explicit WorkerTeam(std::size_t helpers) {
    try {
      for (std::size_t i = 0; i < helpers; ++i) threads_.emplace_back([this] { serve(); });
    } catch (...) {
      dismiss();  // otherwise the threads started so far could not be joined
      throw;
    }
  }
  WorkerTeam(const WorkerTeam&) = delete;
  WorkerTeam& operator=(const WorkerTeam&) = delete;
  ~WorkerTeam() { dismiss(); }

  [[nodiscard]] std::size_t helpers() const noexcept { return threads_.size(); }

  void run(Job& job) {
    job_ = &job;
    state_ = call_of(state_) + one_call + is_open;
    state_.notify_all();
    job.take_parts();
    state_ &= ~is_open;
    if (holds_soon([this] { return inside(state_) == 0; })) return;
    for (State state = state_; inside(state) > 0; state = state_) state_.wait(state);
  }

 private:
  /// The bits from the lowest: whether the job is open, how many helpers work on it, and the number of the call, which
  /// starts again where it overflows.
  using State = std::uint32_t;
  static constexpr State is_open = 1;
  static constexpr State one_inside = 2;
  static constexpr State one_call = 2 * 1024 * one_inside;
  static_assert(most_threads <= one_call / one_inside - 1);

  /// Lets the threads end.
  void dismiss() {
    is_over_ = true;
    state_ += one_call;
    state_.notify_all();
  }

  static State inside(State state) { return state % one_call / one_inside; }
  static State call_of(State state) { return state - state % one_call; }

  void serve() {
    for (State served = 0;;) {
      const auto is_awaited = [&] { return ((state_ & is_open) != 0 && call_of(state_) != served) || is_over_; };
      if (!holds_soon(is_awaited)) {
        const State state = state_;
        if (!is_awaited()) state_.wait(state);
        continue;
      }
      if (is_over_) return;
      State state = state_;
      if ((state & is_open) == 0 || !state_.compare_exchange_strong(state, state + one_inside)) continue;
      served = call_of(state);
      job_->take_parts();
      const State left = state_ -= one_inside;
      if ((left & is_open) == 0 && inside(left) == 0) state_.notify_all();
    }
  }

  std::atomic<State> state_{0};
  std::atomic<bool> is_over_{false};
  Job* job_ = nullptr;                 // of the call that is open; written between calls only
  std::vector<std::jthread> threads_;  // last: they use the rest, and are waited for before it goes
};

std::size_t count_from_environment() {
  const char* wanted = std::getenv("DMOCBENCH_THREADS");  // NOLINT(concurrency-mt-unsafe): only read
  if (wanted == nullptr) return std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, most_threads);
  const std::size_t count = parsed<std::size_t>(wanted).value_or(0);
  if (count < 1 || count > most_threads) {
    throw Error("DMOCBENCH_THREADS=" + std::string(wanted) + " is not a number of threads; give one from 1 to 1024");
  }
  return count;
}

std::atomic<std::size_t> count_that_was_set{0};  // 0 until it is

std::mutex team_is_in_use;

/// The team of this process. A forked process has none of its parent's threads, and must not even touch their data: it
/// gets its own team, and the parent's team is left in place. Teams are never destroyed: a child without its own team
/// would wait for threads of another process.
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
    throw Error("the number of threads must lie between 1 and {}, got {}", most_threads, count);
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
