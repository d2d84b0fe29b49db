#include "methods/expression/slot_plan.hpp"

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

/// For every step, the last compound that reads it.
std::vector<std::size_t> last_readers(const std::vector<CompoundStep>& compounds, std::size_t steps) {
  std::vector<std::size_t> last(steps, compounds.size());
  for (std::size_t c = 0; c < compounds.size(); ++c) {
    for (std::size_t i = 0; i < compounds[c].operand_count; ++i) last[compounds[c].operands[i]] = c;
  }
  return last;
}

}  // namespace

SlotPlan::SlotPlan(const Schedule& schedule, const std::vector<CompoundStep>& compounds)
    : places_(schedule.steps().size()) {
  place_constants_and_inputs(schedule);
  place_outputs(schedule);
  place_in_slots(compounds);
}

void SlotPlan::place_constants_and_inputs(const Schedule& schedule) {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Schedule::Step& step = schedule.steps()[i];
    if (step.operation == Operation::constant) {
      places_[i] = {Kind::constant, static_cast<std::uint32_t>(constants_.size())};
      constants_.push_back(step.value);
    } else if (step.operation == Operation::input) {
      places_[i] = {Kind::input, static_cast<std::uint32_t>(inputs_.size())};
      inputs_.push_back(step.input_index);
    }
  }
}

void SlotPlan::place_outputs(const Schedule& schedule) {
  for (std::uint32_t j = 0; j < schedule.outputs().size(); ++j) {
    Place& place = places_[schedule.outputs()[j]];
    if (place.kind == Kind::nowhere) place = {Kind::output, j};
  }
}

void SlotPlan::place_in_slots(const std::vector<CompoundStep>& compounds) {
  const std::vector<std::size_t> last = last_readers(compounds, places_.size());
  SlotPool pool;
  const auto place = [&](std::uint32_t step) {
    if (places_[step].kind == Kind::nowhere) places_[step] = {Kind::slot, pool.take()};
  };
  for (std::size_t c = 0; c < compounds.size(); ++c) {
    const CompoundStep& compound = compounds[c];
    // The slots of operands that die here are free for the result: an instruction may write where it reads.
    const auto* begin = compound.operands.begin();
    for (const auto* operand = begin; operand != begin + compound.operand_count; ++operand) {
      const bool is_first = std::find(begin, operand, *operand) == operand;
      const bool dies = last[*operand] == c && places_[*operand].kind == Kind::slot;
      if (is_first && dies) pool.give_back(places_[*operand].number);
    }
    place(compound.step);
    if (compound.cosine) place(*compound.cosine);
  }
  slot_count_ = pool.count();
}

std::uint32_t SlotPlan::first_input() const noexcept {
  return slot_count_ + static_cast<std::uint32_t>(constants_.size());
}

std::uint32_t SlotPlan::output(std::uint32_t j) const noexcept {
  return first_input() + static_cast<std::uint32_t>(inputs_.size()) + j;
}

std::uint32_t SlotPlan::of(std::uint32_t step) const {
  const Place& place = places_[step];
  switch (place.kind) {
    case Kind::slot:
      return place.number;
    case Kind::constant:
      return slot_count_ + place.number;
    case Kind::input:
      return first_input() + place.number;
    case Kind::output:
      return output(place.number);
    case Kind::nowhere:
      break;
  }
  throw Error("this step's value is not kept");
}

}  // namespace dmocbench
