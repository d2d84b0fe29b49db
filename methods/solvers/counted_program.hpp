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
  [[nodiscard]] double seconds() const noexcept { return seconds_; }

  [[nodiscard]] std::size_t variable_count() const override { return program_.variable_count(); }
  [[nodiscard]] std::size_t constraint_count() const override { return program_.constraint_count(); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return program_.variable_lower(); }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return program_.variable_upper(); }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return program_.constraint_lower(); }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return program_.constraint_upper(); }
  [[nodiscard]] const BlockPattern& jacobian_structure() const override { return program_.jacobian_structure(); }
  [[nodiscard]] const BlockPattern& hessian_structure() const override { return program_.hessian_structure(); }
  [[nodiscard]] double rounding_floor() const override { return program_.rounding_floor(); }
  [[nodiscard]] const IntervalStructure* interval_structure() const override { return program_.interval_structure(); }

  [[nodiscard]] double objective(const VectorIn& x) override {
    const Count count(counts_.objective, seconds_);
    return program_.objective(x);
  }
  void gradient(const VectorIn& x, VectorOut result) override {
    const Count count(counts_.gradient, seconds_);
    program_.gradient(x, result);
  }
  void constraints(const VectorIn& x, VectorOut result) override {
    const Count count(counts_.constraints, seconds_);
    program_.constraints(x, result);
  }
  void jacobian(const VectorIn& x, VectorOut values) override {
    const Count count(counts_.jacobian, seconds_);
    program_.jacobian(x, values);
  }
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override {
    const Count count(counts_.hessian, seconds_);
    program_.hessian(x, objective_factor, multipliers, values);
  }

 private:
  /// Counts one evaluation and adds its time when it ends, whether it returns or throws.
  class Count {
   public:
    Count(int& count, double& seconds) : seconds_(seconds), begin_(Clock::now()) { ++count; }
    ~Count() { seconds_ += seconds_since(begin_); }
    Count(const Count&) = delete;
    Count& operator=(const Count&) = delete;
    Count(Count&&) = delete;
    Count& operator=(Count&&) = delete;

   private:
    double& seconds_;
    Clock::time_point begin_;
  };

  NonlinearProgram& program_;
  EvaluationCounts counts_;
  double seconds_ = 0.0;
};

}  // namespace dmocbench
