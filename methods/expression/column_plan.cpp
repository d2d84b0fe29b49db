#include "methods/expression/column_plan.hpp"

#include <algorithm>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// Hands out slots and takes them back when a value is dead.
class SlotPool {
 public:
  std::uint32_t take() {
    if (free_.empty()) return count_++;
    const std::uint32_t slot = free_.back();
    free_.pop_back();
    return slot;
  }
  void give_back(std::uint32_t slot) { free_.push_back(slot); }
  [[nodiscard]] std::uint32_t count() const { return count_; }

 private:
  std::vector<std::uint32_t> free_;
  std::uint32_t count_ = 0;
};

/// For every step the last compound that reads it.
std::vector<std::size_t> last_readers(const std::vector<CompoundStep>& compounds, std::size_t steps) {
  std::vector<std::size_t> last(steps, compounds.size());
  for (std::size_t c = 0; c < compounds.size(); ++c) {
    for (std::size_t i = 0; i < compounds[c].operand_count; ++i) last[compounds[c].operands[i]] = c;
  }
  return last;
}

}  // namespace

ColumnPlan::ColumnPlan(const Schedule& schedule, const std::vector<CompoundStep>& compounds)
    : columns_(schedule.steps().size()) {
  place_constants_and_inputs(schedule);
  place_outputs(schedule);
  place_in_slots(compounds);
}

void ColumnPlan::place_constants_and_inputs(const Schedule& schedule) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Schedule::Step& step = schedule.steps()[i];
    if (step.operation == Operation::constant) {
      columns_[i] = {Kind::constant, static_cast<std::uint32_t>(constants_.size())};
      constants_.push_back(step.value);
    } else if (step.operation == Operation::input) {
      columns_[i] = {Kind::input, static_cast<std::uint32_t>(inputs_.size())};
      inputs_.push_back(step.input_index);
    }
  }
}

void ColumnPlan::place_outputs(const Schedule& schedule) {
  for (std::uint32_t j = 0; j < schedule.outputs().size(); ++j) {
    Column& column = columns_[schedule.outputs()[j]];
    if (column.kind == Kind::nowhere) column = {Kind::output, j};
  }
}

void ColumnPlan::place_in_slots(const std::vector<CompoundStep>& compounds) {
  const std::vector<std::size_t> last = last_readers(compounds, columns_.size());
  SlotPool pool;
  const auto place = [&](std::uint32_t step) {
    if (columns_[step].kind == Kind::nowhere) columns_[step] = {Kind::slot, pool.take()};
  };
  for (std::size_t c = 0; c < compounds.size(); ++c) {
    const CompoundStep& compound = compounds[c];
    // Operands that die here give their slots back first: an instruction may write where it reads.
    const auto* begin = compound.operands.begin();
    for (const auto* operand = begin; operand != begin + compound.operand_count; ++operand) {
      const bool is_first = std::find(begin, operand, *operand) == operand;
      const bool dies = last[*operand] == c && columns_[*operand].kind == Kind::slot;
      if (is_first && dies) pool.give_back(columns_[*operand].number);
    }
    place(compound.step);
    if (compound.cosine) place(*compound.cosine);
  }
  slot_count_ = pool.count();
}

std::uint32_t ColumnPlan::first_input() const noexcept {
  return slot_count_ + static_cast<std::uint32_t>(constants_.size());
}

std::uint32_t ColumnPlan::output(std::uint32_t j) const noexcept {
  return first_input() + static_cast<std::uint32_t>(inputs_.size()) + j;
}

std::uint32_t ColumnPlan::of(std::uint32_t step) const {
  const Column& column = columns_[step];
  switch (column.kind) {
    case Kind::slot:
      return column.number;
    case Kind::constant:
      return slot_count_ + column.number;
    case Kind::input:
      return first_input() + column.number;
    case Kind::output:
      return output(column.number);
    case Kind::nowhere:
      break;
  }
  throw Error("this step's value is not kept");
}

}  // namespace dmocbench
