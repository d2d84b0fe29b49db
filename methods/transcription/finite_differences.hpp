#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "methods/expression/tape.hpp"
#include "methods/transcription/column_assembly.hpp"
#include "methods/transcription/derivative_back_end.hpp"

namespace dmocbench {

/// The sides of a point at which values are taken.
enum class DifferenceKind : std::uint8_t {
  central,  ///< on both: error O(step²)
  forward,  ///< on one: error O(step), half the evaluations
};

/// The step relative to max(1, |x|) that balances truncation and a rounding of ε in the values, ε = 2.2e-16.
///
/// | | formula | step | error, where function and derivatives are of size 1 |
/// |---|---|---|---|
/// | central, first | (f₊ - f₋)/2s | ε^(1/3) = 6e-6 | ε^(2/3) = 4e-11 |
/// | forward, first | (f₊ - f)/s | ε^(1/2) = 1.5e-8 | ε^(1/2) = 1.5e-8 |
/// | central, second | (f₊₊ - f₊₋ - f₋₊ + f₋₋)/4st, (f₊ - 2f + f₋)/s² | ε^(1/4) = 1.2e-4 | ε^(1/2) = 1.5e-8 |
/// | forward, second | (f₊₊ - f₊ - f₊ + f)/st | ε^(1/3) = 6e-6 | ε^(1/3) = 6e-6 |
[[nodiscard]] double difference_step(DifferenceKind kind, int derivative);

/// First and second derivatives by differences of values. Of the formulas' derivatives, only the pattern is used: which
/// entries vanish for every motion.
///
/// The same local unknown is moved in all intervals at once: the tapes of the values then give a difference for every
/// interval in one pass. With n local unknowns a Jacobian takes 2n (central) or n + 1 (forward) passes over the rows,
/// the Hessian of ℓ at most 2n² + 1 or n(n + 3)/2 + 1 passes over ℓ. Values divided by the step of the grid lose
/// digits as it gets smaller, and so do these derivatives. Allocates nothing in an evaluation.
class FiniteDifferences final : public DerivativeBackEnd {
 public:
  FiniteDifferences(const LocalFunctions& functions, const DerivativePlaces& places, DifferenceKind kind);

  void gradient(Inputs inputs, VectorOut result) override;
  void jacobian(Inputs inputs, VectorOut values) override;
  void hessian(Inputs inputs, VectorOut values) override;

 private:
  /// Formulas to be differentiated: a tape, and memory for its values at the point and at moved points.
  struct Formulas {
    Formulas(const Schedule& schedule, std::size_t interval_count, std::size_t points);
    [[nodiscard]] const double* value(std::size_t point, std::size_t output) const;

    Tape tape;
    Tape::Workspace workspace;
    std::size_t intervals;
    std::vector<double> values;   // point by point, output by output
    std::vector<double*> series;  // where they begin
  };
  /// A derivative of first order: ∂output/∂unknown is entry `entry`.
  struct Quotient {
    std::size_t output;
    std::size_t entry;
  };
  /// A derivative of second order: its entry is its position.
  struct Curvature {
    std::size_t first;
    std::size_t second;
  };

  void bind(Inputs inputs, double relative_step);
  void move(std::size_t slot, std::size_t unknown, double factor);
  void restore(std::size_t unknown) { inputs_[unknown] = original_[unknown]; }
  void evaluate(Formulas& formulas, std::size_t point);
  void quotients(Formulas& formulas, const std::vector<std::vector<Quotient>>& entries,
                 std::span<double* const> results);
  void central_curvatures(std::span<double* const> results);
  void forward_curvatures(std::span<double* const> results);

  [[nodiscard]] const double* steps_of(std::size_t unknown) const { return steps_.data() + unknown * intervals_; }

  DifferenceKind kind_;
  std::size_t intervals_;
  std::size_t unknowns_;
  Formulas cost_;
  Formulas rows_;
  Formulas lagrangian_;
  std::vector<std::vector<Quotient>> gradient_entries_;  // per local unknown
  std::vector<std::vector<Quotient>> jacobian_entries_;
  std::vector<Curvature> hessian_entries_;
  ColumnAssembly gradient_;
  ColumnAssembly jacobian_;
  ColumnAssembly hessian_;
  std::vector<Tape::Input> original_;
  std::vector<Tape::Input> inputs_;  // with moved unknowns
  std::vector<double> steps_;        // unknown by unknown
  std::vector<double> moved_;        // two series: a second difference moves two unknowns
};

}  // namespace dmocbench
