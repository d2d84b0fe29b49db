#pragma once

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/runtime/clock.hpp"

namespace dmocbench {

/// A program as a solver sees it: counts and times every evaluation, and holds the clock.
///
/// `Solver::solve` hands it to every solver alike, so that their counts and their limits of time mean the same.
class CountedProgram final : public ForwardingProgram {
 public:
  /// `program` must outlive it. The solve may take this many seconds of wall clock, 0 for no limit.
  explicit CountedProgram(NonlinearProgram& program, double most_seconds = 0.0) : ForwardingProgram(program) {
    if (most_seconds > 0.0) most_seconds_ = most_seconds;
  }

  /// Begins to count and to measure again, for another solve.
  void restart(double most_seconds) {
    counts_ = {};
    seconds_ = 0.0;
    left_out_ = 0.0;
    most_seconds_ = unbounded;
    if (most_seconds > 0.0) most_seconds_ = most_seconds;
    begin_ = Clock::now();
  }

  /// The program itself, for judging a point: its evaluations are not counted.
  [[nodiscard]] NonlinearProgram& uncounted() const noexcept { return original(); }
  /// The evaluations so far.
  [[nodiscard]] const EvaluationCounts& counts() const noexcept { return counts_; }
  /// Time spent in the evaluations that are counted.
  [[nodiscard]] double evaluation_seconds() const noexcept { return seconds_; }

  /// Time since the solve began, without the time left out.
  [[nodiscard]] double elapsed_seconds() const { return seconds_since(begin_) - left_out_; }
  /// Does not count a time just spent: a vendor's library sets itself up before it reads the program, which is
  /// unrelated to its method. The limit of time does count it.
  void leave_out(double seconds) { left_out_ += seconds; }
  /// The remaining time of the solve; infinity without a limit.
  [[nodiscard]] double seconds_left() const { return most_seconds_ - seconds_since(begin_); }
  /// True if the time of the solve is over.
  [[nodiscard]] bool is_out_of_time() const { return seconds_left() < 0.0; }

  [[nodiscard]] double objective(const VectorIn& x) override {
    double value = 0.0;
    count(counts_.objective, [&] { value = original().objective(x); });
    return value;
  }
  void gradient(const VectorIn& x, VectorOut result) override {
    count(counts_.gradient, [&] { original().gradient(x, result); });
  }
  void constraints(const VectorIn& x, VectorOut result) override {
    count(counts_.constraints, [&] { original().constraints(x, result); });
  }
  void jacobian(const VectorIn& x, VectorOut values) override {
    count(counts_.jacobian, [&] { original().jacobian(x, values); });
  }
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override {
    count(counts_.hessian, [&] { original().hessian(x, objective_factor, multipliers, values); });
  }

 private:
  template <class Evaluation>
  void count(int& calls, const Evaluation& evaluate) {
    ++calls;
    const Clock::time_point begin = Clock::now();
    evaluate();
    seconds_ += seconds_since(begin);
  }

  EvaluationCounts counts_;
  double seconds_ = 0.0;
  double most_seconds_ = unbounded;
  double left_out_ = 0.0;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace dmocbench
