#pragma once

#include <cstdint>
#include <vector>

#include "methods/expression/compound_steps.hpp"
#include "methods/expression/schedule.hpp"

namespace dmocbench {

/// Where a tape keeps the values of a schedule's steps: positions in its table of series, which holds first the slots,
/// then the constants, the inputs that are read, and the outputs.
///
/// A slot is reused as soon as its value is dead, so that few are needed. The value of an output is written to the
/// output at once, and later readers read it there.
class SlotPlan {
 public:
  SlotPlan(const Schedule& schedule, const std::vector<CompoundStep>& compounds);

  [[nodiscard]] std::uint32_t slot_count() const noexcept { return slot_count_; }
  [[nodiscard]] const std::vector<double>& constants() const noexcept { return constants_; }
  /// Numbers of the inputs that are read; the first of them is at position `first_input`.
  [[nodiscard]] const std::vector<std::size_t>& inputs() const noexcept { return inputs_; }
  [[nodiscard]] std::uint32_t first_input() const noexcept;
  /// The position of output `j`.
  [[nodiscard]] std::uint32_t output(std::uint32_t j) const noexcept;
  /// The position of a step's value. Throws `Error` if the value stays within a compound.
  [[nodiscard]] std::uint32_t of(std::uint32_t step) const;

 private:
  enum class Kind : std::uint8_t { nowhere, slot, constant, input, output };
  struct Place {
    Kind kind = Kind::nowhere;
    std::uint32_t number = 0;
  };

  void place_constants_and_inputs(const Schedule& schedule);
  void place_outputs(const Schedule& schedule);
  void place_in_slots(const std::vector<CompoundStep>& compounds);

  std::vector<Place> places_;  // of the steps
  std::vector<double> constants_;
  std::vector<std::size_t> inputs_;
  std::uint32_t slot_count_ = 0;
};

}  // namespace dmocbench
