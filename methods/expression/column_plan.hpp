#pragma once

#include <cstdint>
#include <vector>

#include "methods/expression/compound_steps.hpp"
#include "methods/expression/schedule.hpp"

namespace dmocbench {

/// Where the values of a schedule's steps are: positions in a table of columns, which holds first the slots, then the
/// constants, then the inputs that are read, then the outputs.
///
/// A slot is taken over as soon as its value is dead, so that few are needed. What is an output goes there directly,
/// and later readers read it there.
class ColumnPlan {
 public:
  ColumnPlan(const Schedule& schedule, const std::vector<CompoundStep>& compounds);

  [[nodiscard]] std::uint32_t slot_count() const noexcept { return slot_count_; }
  [[nodiscard]] const std::vector<double>& constants() const noexcept { return constants_; }
  /// Numbers of the inputs that are read; the first has the column `first_input`.
  [[nodiscard]] const std::vector<std::size_t>& inputs() const noexcept { return inputs_; }
  [[nodiscard]] std::uint32_t first_input() const noexcept;
  /// Of output `j`.
  [[nodiscard]] std::uint32_t output(std::uint32_t j) const noexcept;
  /// Of a step's value; not of one that stays within a compound.
  [[nodiscard]] std::uint32_t of(std::uint32_t step) const;

 private:
  enum class Kind : std::uint8_t { nowhere, slot, constant, input, output };
  struct Column {
    Kind kind = Kind::nowhere;
    std::uint32_t number = 0;
  };

  void place_constants_and_inputs(const Schedule& schedule);
  void place_outputs(const Schedule& schedule);
  void place_in_slots(const std::vector<CompoundStep>& compounds);

  std::vector<Column> columns_;  // by steps
  std::vector<double> constants_;
  std::vector<std::size_t> inputs_;
  std::uint32_t slot_count_ = 0;
};

}  // namespace dmocbench
