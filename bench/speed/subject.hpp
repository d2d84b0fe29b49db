#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "methods/expression/schedule.hpp"
#include "methods/expression/tape.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench::speed {

/// Which formulas are timed.
struct Formulas {
  std::string problem;          ///< a name of the registry
  int links = 0;                ///< of the problem `link_chain`; 0 for all others
  std::string method = "dmoc";  ///< a family of elements
  int stages = 1;               ///< of the Gauss tableau

  /// The problem and, where there are any, its links: "link_chain_3".
  [[nodiscard]] std::string label() const;
};

/// What is timed: a problem by a method on a grid of uneven steps, at a random point.
///
/// The time of an evaluation depends on the formulas, not on the numbers; random ones keep any step of the check before
/// the timing from being trivially right.
class Subject {
 public:
  static constexpr std::size_t intervals = 1024;

  explicit Subject(const Formulas& formulas);

  /// `Formulas::label`.
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }
  [[nodiscard]] Transcription& program() noexcept { return program_; }
  [[nodiscard]] const IntervalFunctions& functions() const noexcept { return program_.functions(); }

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
  std::string problem_;
  Transcription program_;
  Eigen::VectorXd x_;
  Eigen::VectorXd multipliers_;
  std::vector<Tape::Input> columns_;
  std::vector<double> by_interval_;
};

/// Columns of doubles that a schedule reads. What neighbouring intervals share (the right end of one is the left end of
/// the next) stands in one array and counts once; what is the same for all intervals does not count.
[[nodiscard]] std::size_t arrays_read(const Schedule& schedule, std::span<const Tape::Input> columns);

/// An interval's share of the Lagrangian, ℓ = factor · cost + multipliers · rows, with common subexpressions shared.
[[nodiscard]] Schedule lagrangian_of(const IntervalFunctions& functions);

/// Rows, Jacobian and Hessian by one schedule: what the three have in common is computed once.
[[nodiscard]] Schedule fused(const IntervalFunctions& functions);

}  // namespace dmocbench::speed
