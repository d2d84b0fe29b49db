#pragma once

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/runtime/clock.hpp"

namespace dmocbench {

/// A program as a solver sees it: forwards everything, and counts and times every evaluation.
///
/// `Solver::solve` hands it to every solver alike, so that their counts mean the same.
class CountedProgram final : public NonlinearProgram {
 public:
  /// `program` must outlive it.
  explicit CountedProgram(NonlinearProgram& program) : program_(program) {}

  /// The program itself, for judging a point: what is asked of it is not counted.
  [[nodiscard]] NonlinearProgram& uncounted() const noexcept { return program_; }
  [[nodiscard]] const EvaluationCounts& counts() const noexcept { return counts_; }
  /// Time spent in the evaluations that are counted.
  [[nodiscard]] double evaluation_seconds() const noexcept { return seconds_; }

  /// Time since the solve began.
  [[nodiscard]] double elapsed_seconds() const { return seconds_since(begin_); }
  /// Lets the solve begin now: a vendor's library sets itself up before it looks at the program, and that time says
  /// nothing about its method.
  void restart_clock() { begin_ = Clock::now(); }

  [[nodiscard]] std::size_t variable_count() const override { return program_.variable_count(); }
  [[nodiscard]] std::size_t constraint_count() const override { return program_.constraint_count(); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return program_.variable_lower(); }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return program_.variable_upper(); }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return program_.constraint_lower(); }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return program_.constraint_upper(); }
  [[nodiscard]] const BlockPattern& jacobian_structure() const override { return program_.jacobian_structure(); }
  [[nodiscard]] const BlockPattern& hessian_structure() const override { return program_.hessian_structure(); }
  [[nodiscard]] const RoundingFloors& rounding_floors() const override { return program_.rounding_floors(); }
  [[nodiscard]] const IntervalStructure* interval_structure() const override { return program_.interval_structure(); }

  [[nodiscard]] double objective(const VectorIn& x) override {
    double value = 0.0;
    count(counts_.objective, [&] { value = program_.objective(x); });
    return value;
  }
  void gradient(const VectorIn& x, VectorOut result) override {
    count(counts_.gradient, [&] { program_.gradient(x, result); });
  }
  void constraints(const VectorIn& x, VectorOut result) override {
    count(counts_.constraints, [&] { program_.constraints(x, result); });
  }
  void jacobian(const VectorIn& x, VectorOut values) override {
    count(counts_.jacobian, [&] { program_.jacobian(x, values); });
  }
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override {
    count(counts_.hessian, [&] { program_.hessian(x, objective_factor, multipliers, values); });
  }

 private:
  template <class Evaluation>
  void count(int& calls, const Evaluation& evaluate) {
    ++calls;
    const Clock::time_point begin = Clock::now();
    evaluate();
    seconds_ += seconds_since(begin);
  }

  NonlinearProgram& program_;
  EvaluationCounts counts_;
  double seconds_ = 0.0;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace dmocbench
