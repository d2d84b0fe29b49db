#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "methods/expression/schedule.hpp"
#include "methods/expression/tape.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench::speed {

/// A choice of formulas.
struct Formulas {
  std::string problem;          ///< a name of the registry
  int links = 0;                ///< of the problem `link_chain`; 0 for all others
  std::string method = "dmoc";  ///< a family of elements
  int stages = 1;               ///< of the Gauss tableau
};

/// A problem by a method on a grid of uneven steps, at a random point.
///
/// The time of an evaluation depends on the formulas, not on the numbers; with random ones no comparison of values
/// (`require_agreement`) is trivially right.
class BenchmarkedFormulas {
 public:
  static constexpr std::size_t intervals = 1024;

  explicit BenchmarkedFormulas(Formulas formulas);

  [[nodiscard]] const Formulas& formulas() const noexcept { return formulas_; }
  [[nodiscard]] Transcription& program() noexcept { return program_; }
  [[nodiscard]] const IntervalFunctions& functions() const noexcept { return program_.functions(); }
  /// The schedules of `quantities`: residual, Jacobian, Hessian of the Lagrangian.
  [[nodiscard]] std::array<const Schedule*, 3> schedules() const noexcept {
    return {&functions().rows.schedule, &functions().jacobian.schedule, &functions().hessian.schedule};
  }

  // The point, as the program takes it.
  [[nodiscard]] const Eigen::VectorXd& x() const noexcept { return x_; }
  [[nodiscard]] const Eigen::VectorXd& multipliers() const noexcept { return multipliers_; }
  static constexpr double objective_factor = 0.75;

  /// The same point, as a tape takes it: one column per input.
  [[nodiscard]] std::span<const Tape::Input> columns() const noexcept { return columns_; }
  /// The same point, as code takes it that treats one interval at a time: all inputs of interval k together.
  [[nodiscard]] std::span<const double> inputs_of(std::size_t interval) const noexcept {
    return std::span(by_interval_).subspan(interval * columns_.size(), columns_.size());
  }

 private:
  Formulas formulas_;
  Transcription program_;
  Eigen::VectorXd x_;
  Eigen::VectorXd multipliers_;
  std::vector<Tape::Input> columns_;
  std::vector<double> by_interval_;
};

/// The formulas of the paper's problems, DMOC with the midpoint rule; they must outlive the run.
using FormulasOfPaper = std::vector<std::unique_ptr<BenchmarkedFormulas>>;

/// The names of `BenchmarkedFormulas::schedules`.
inline constexpr std::array quantities{"residual", "jacobian", "hessian"};

/// Residual, Jacobian and Hessian by one schedule: common subexpressions are computed once.
[[nodiscard]] Schedule fused(const BenchmarkedFormulas& formulas);

}  // namespace dmocbench::speed
