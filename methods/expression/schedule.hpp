#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/expression/vectors.hpp"

namespace dmocbench {

/// Inputs that stand for formulas: `inputs[i]` for `formulas[i]`, which reads none of the inputs.
struct Definitions {
  ExpressionVector inputs;    ///< read by other formulas
  ExpressionVector formulas;  ///< their definitions, as many
};

/// The operations that given outputs need, in an order in which they can be carried out.
///
/// Plain data without the graph: it may be handed to another thread and outlives the expressions that it came from.
/// `replay` runs it on any scalar, `Tape` on many intervals at once.
class Schedule {
 public:
  /// One value of the schedule. `left` and `right` are positions of earlier steps.
  struct Step {
    Operation operation = Operation::constant;  ///< how it is computed
    std::uint32_t left = 0;                     ///< index of the first operand's step
    std::uint32_t right = 0;                    ///< index of the second operand's step
    double value = 0.0;                         ///< of a constant, or the exponent of a power
    std::size_t input_index = 0;                ///< of an input
  };

  Schedule() = default;
  /// The code that computes these outputs, in their order.
  explicit Schedule(std::span<const Expression> outputs) : Schedule(outputs, Definitions{}) {}
  /// The same, with formulas in place of the inputs that stand for them.
  Schedule(std::span<const Expression> outputs, const Definitions& definitions);
  /// The same of a vector.
  explicit Schedule(const ExpressionVector& outputs) : Schedule(entries_of(outputs)) {}

  /// All steps, operands before those that read them.
  [[nodiscard]] const std::vector<Step>& steps() const noexcept { return steps_; }
  /// Positions of the outputs among the steps, in the order in which they were given.
  [[nodiscard]] const std::vector<std::uint32_t>& outputs() const noexcept { return outputs_; }
  /// One more than the largest number of an input that is read; 0 if none is.
  [[nodiscard]] std::size_t input_count() const noexcept { return input_count_; }
  /// The number of steps that compute: all but constants and inputs.
  [[nodiscard]] std::size_t operation_count() const noexcept;

 private:
  std::vector<Step> steps_;
  std::vector<std::uint32_t> outputs_;
  std::size_t input_count_ = 0;
};

}  // namespace dmocbench
