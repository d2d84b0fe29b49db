#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <span>
#include <thread>

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/runtime/lane_loops.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/batch/batch.hpp"
#include "methods/solvers/batch/batch_source.hpp"

namespace dmocbench::batch {

/// A lock that records whether the calling thread holds it.
class KnownLock {
 public:
  void lock() {
    mutex_.lock();
    holder_ = std::this_thread::get_id();
  }
  void unlock() {
    holder_ = std::thread::id();
    mutex_.unlock();
  }
  [[nodiscard]] bool is_mine() const { return holder_ == std::this_thread::get_id(); }

 private:
  std::mutex mutex_;
  std::atomic<std::thread::id> holder_;
};

/// The answer to an instance.
struct Answer {
  std::size_t index = 0;
  Solution solution;
};

/// The state that all threads of a batch share: the source, the program that evaluates single solves, and how it went.
class SharedBatch {
 public:
  /// In the thread of the caller, whose `StopScope` counts. The time begins.
  SharedBatch(NonlinearProgram& program, BatchSource& source, const BatchOptions& options);

  /// While no thread works.
  void begin_generation() noexcept;
  /// Whether all generations have ended.
  [[nodiscard]] bool has_ended() const { return has_ended_; }
  [[nodiscard]] bool is_stopped() const { return is_stopped_; }
  /// "time limit" or "interrupted": of instances that are not finished where the batch was stopped.
  [[nodiscard]] Status status_of_stop() const {
    return limits_.seconds_left() > 0.0 ? Status::interrupted : Status::time_limit;
  }

  /// Fills a group of instances, as far as there are any; returns how many. Threads wait for each other where the
  /// source hands out instances, but not where it searches.
  [[nodiscard]] std::size_t hand_out(std::span<Assignment> group);
  void take(std::span<const Answer> answers);
  [[nodiscard]] Solution solve_alone(const BatchInstance& instance);
  void confirm(const BatchInstance& instance, Solution& solution);
  void count_round();
  /// Adds the times of a thread by phase.
  void add_seconds(const BatchSeconds& seconds);

  /// Work of a thread; an exception ends the batch.
  template <class Work>
  void guard(const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      fail(std::current_exception());
    }
  }
  /// Once all threads have ended; rethrows the first exception.
  [[nodiscard]] BatchSummary summary();

  [[nodiscard]] const NonlinearProgram& program() const { return program_; }
  [[nodiscard]] const BatchOptions& options() const { return options_; }

 private:
  template <class Use>
  auto with_instance(const BatchInstance& instance, const Use& use);
  void fail(std::exception_ptr error) noexcept;
  /// The rest of the time, for the scope of a thread.
  [[nodiscard]] double seconds_of_a_scope() const;

  NonlinearProgram& program_;
  BatchSource& source_;
  const BatchOptions& options_;
  StopScope limits_;        // of the caller's thread; others ask it
  KnownLock handing_out_;   // `source_` except `search` and `take`; `handed_out_`
  std::mutex taking_;       // `BatchSource::take`, `error_`, seconds
  std::mutex program_use_;  // `program_`
  std::size_t handed_out_ = 0;
  bool is_exhausted_ = false;  // the generation is
  bool has_ended_ = false;
  std::atomic<bool> is_stopped_{false};
  std::atomic<std::size_t> rounds_{0};
  BatchSummary summary_;
  std::exception_ptr error_;
};

/// The queue from which eight lanes of a thread fetch instances and to which they return answers, in groups, so that
/// threads seldom meet.
class BatchQueue {
 public:
  /// `parameters`: how many an instance has.
  BatchQueue(SharedBatch& batch, std::size_t parameters) : batch_(batch), parameters_(parameters) {}

  /// The next instance that lanes can begin with; false if there is none left.
  [[nodiscard]] bool fetch(Assignment& assignment);
  /// Takes an answer, and leaves an earlier one whose memory may be used again.
  void deliver(std::size_t index, Solution& solution);
  /// Solves an instance that the lanes cannot finish, and delivers the answer.
  void solve_one_by_one(const Assignment& assignment, const Solution& so_far);
  /// `Confirmation::judge` of an answer. Where the tolerance does not constrain its cost or a constraint
  /// (`Confirmation::scaling`), the instance is solved one by one, or, where the batch does not fall back and the cost
  /// is too small, not confirmed.
  void confirm(const Assignment& assignment, Solution& solution) { batch_.confirm(assignment.instance, solution); }
  [[nodiscard]] bool is_stopped() const { return batch_.is_stopped(); }
  [[nodiscard]] Status status_of_stop() const { return batch_.status_of_stop(); }
  void count_round() { batch_.count_round(); }
  /// Call when all lanes are idle: delivers the remaining answers and adds the seconds.
  void end_generation(const BatchSeconds& seconds);

 private:
  [[nodiscard]] Solution check(const BatchInstance& instance) const;
  void deliver_answers();

  SharedBatch& batch_;
  std::size_t parameters_;
  std::array<Assignment, instance_lanes> group_;
  std::size_t handed_out_ = 0;  // of the group
  std::size_t fetched_ = 0;     // of these
  std::array<Answer, instance_lanes> answers_;
  std::size_t answered_ = 0;
};

}  // namespace dmocbench::batch
