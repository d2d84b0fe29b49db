#include "methods/expression/native/register_allocation.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "methods/expression/native/step_order.hpp"

namespace dmocbench {

namespace {

constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();

/// The step that reads the operands of a step next, after that step.
struct NextReaders {
  std::uint32_t of_left = never;
  std::uint32_t of_right = never;
};

bool commutes(VectorOperation operation) {
  return operation == VectorOperation::add || operation == VectorOperation::multiply;
}

class RegisterAllocator {
 public:
  RegisterAllocator(const std::vector<VectorStep>& steps, const std::vector<NativePlan::Home>& homes,
                    std::size_t registers)
      : steps_(steps), homes_(homes), values_(homes.size()), holders_(registers, never), next_readers_(steps.size()) {
    for (std::size_t i = steps.size(); i-- > 0;) {
      const VectorStep& step = steps[i];
      next_readers_[i].of_left = values_[step.left].next_reader;
      if (operand_count(step.operation) > 1) next_readers_[i].of_right = values_[step.right].next_reader;
      values_[step.left].next_reader = static_cast<std::uint32_t>(i);
      values_[step.right].next_reader = static_cast<std::uint32_t>(i);
    }
  }

  MachineSteps allocate() {
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (steps_[i].operation == VectorOperation::copy) {
        copy(steps_[i], next_readers_[i]);
      } else {
        compute(steps_[i], next_readers_[i]);
      }
    }
    return std::move(result_);
  }

 private:
  struct Value {
    std::uint32_t register_number = never;
    std::uint32_t stack_place = never;
    std::uint32_t next_reader = never;  // a step
  };

  void copy(const VectorStep& step, const NextReaders& next) {
    const OperandPlace source = loaded(step.left, step);
    emit({VectorOperation::copy, {OperandPlace::Kind::series, step.result}, source, source});
    has_been_read(step.left, next.of_left);
    free_stack_place_of_dead(step.left);
  }

  void compute(VectorStep step, NextReaders next) {
    const bool is_binary = operand_count(step.operation) > 1;
    // An operand in memory that is not read again becomes the right one, if the operation commutes.
    if (is_binary && commutes(step.operation) && !is_loaded(step.left) &&
        (is_loaded(step.right) || next.of_left == never)) {
      std::swap(step.left, step.right);
      std::swap(next.of_left, next.of_right);
    }
    const OperandPlace left = loaded(step.left, step);
    OperandPlace right = left;
    if (is_binary) {
      const bool stays_in_memory = !is_loaded(step.right) && next.of_right == never;
      right = stays_in_memory ? in_memory(step.right) : loaded(step.right, step);
    }
    has_been_read(step.left, next.of_left);
    if (is_binary) has_been_read(step.right, next.of_right);
    const OperandPlace result = free_register({never, never});
    give(step.result, result.number);
    emit({step.operation, result, left, right});
    // Only now: a value that is stored to free a register for the result must not overwrite an operand.
    free_stack_place_of_dead(step.left);
    if (is_binary) free_stack_place_of_dead(step.right);
  }

  [[nodiscard]] bool is_loaded(std::uint32_t value) const { return values_[value].register_number != never; }

  /// The register of an operand of a step, loaded if necessary.
  OperandPlace loaded(std::uint32_t value, const VectorStep& step) {
    if (!is_loaded(value)) {
      const OperandPlace place = free_register({step.left, step.right});
      emit({VectorOperation::copy, place, in_memory(value), {}});
      give(value, place.number);
    }
    return {OperandPlace::Kind::in_register, values_[value].register_number};
  }

  /// A free register. Values other than those that must stay leave theirs, the one that is needed last.
  OperandPlace free_register(std::pair<std::uint32_t, std::uint32_t> staying) {
    const auto need_of = [&](std::uint32_t holder) -> std::uint64_t {
      if (holder == never) return std::uint64_t{never} + 1;  // free already
      return holder == staying.first || holder == staying.second ? 0 : values_[holder].next_reader;
    };
    const auto last = std::ranges::max_element(holders_, {}, need_of);
    if (*last != never) evict(*last);
    return {OperandPlace::Kind::in_register, static_cast<std::uint32_t>(last - holders_.begin())};
  }

  void evict(std::uint32_t value) {
    const OperandPlace place{OperandPlace::Kind::in_register, values_[value].register_number};
    if (!has_home(value) && values_[value].stack_place == never) {
      values_[value].stack_place = free_stack_place();
      emit({VectorOperation::copy, in_memory(value), place, {}});
    }
    release_register(value);
  }

  void give(std::uint32_t value, std::uint32_t register_number) {
    values_[value].register_number = register_number;
    holders_[register_number] = value;
  }
  void release_register(std::uint32_t value) {
    if (!is_loaded(value)) return;
    holders_[values_[value].register_number] = never;
    values_[value].register_number = never;
  }

  /// A value that no further step reads leaves its register.
  void has_been_read(std::uint32_t value, std::uint32_t next_reader) {
    values_[value].next_reader = next_reader;
    if (next_reader == never) release_register(value);
  }
  void free_stack_place_of_dead(std::uint32_t value) {
    if (values_[value].next_reader != never || values_[value].stack_place == never) return;
    free_stack_places_.push_back(values_[value].stack_place);
    values_[value].stack_place = never;
  }

  std::uint32_t free_stack_place() {
    if (free_stack_places_.empty()) return static_cast<std::uint32_t>(result_.stack_places++);
    const std::uint32_t place = free_stack_places_.back();
    free_stack_places_.pop_back();
    return place;
  }

  [[nodiscard]] bool has_home(std::uint32_t value) const { return homes_[value].constant || homes_[value].series; }

  [[nodiscard]] OperandPlace in_memory(std::uint32_t value) const {
    const NativePlan::Home& home = homes_[value];
    if (home.constant) return {OperandPlace::Kind::constant, value};
    if (home.series) return {OperandPlace::Kind::series, *home.series};
    return {OperandPlace::Kind::stack, values_[value].stack_place};
  }

  void emit(const MachineStep& step) { result_.steps.push_back(step); }

  const std::vector<VectorStep>& steps_;
  const std::vector<NativePlan::Home>& homes_;
  std::vector<Value> values_;
  std::vector<std::uint32_t> holders_;  // by registers; `never` where one is free
  std::vector<NextReaders> next_readers_;
  std::vector<std::uint32_t> free_stack_places_;
  MachineSteps result_;
};

std::array<OperandPlace*, 3> places_of(MachineStep& step) { return {&step.result, &step.left, &step.right}; }

bool is_register(const OperandPlace& place) { return place.kind == OperandPlace::Kind::in_register; }
bool is_constant(const OperandPlace& place) { return place.kind == OperandPlace::Kind::constant; }

/// The constants that steps read, those first that are read most often.
std::vector<std::uint32_t> constants_by_use(std::vector<MachineStep>& steps, std::size_t values) {
  std::vector<std::uint32_t> uses(values);
  std::vector<std::uint32_t> constants;
  for (MachineStep& step : steps) {
    for (const OperandPlace* place : places_of(step)) {
      if (is_constant(*place) && uses[place->number]++ == 0) constants.push_back(place->number);
    }
  }
  std::ranges::stable_sort(constants, std::greater<>(), [&](std::uint32_t constant) { return uses[constant]; });
  return constants;
}

/// Steps read the constants where they are kept, by values; loads of them are left out.
void read_kept(std::vector<MachineStep>& steps, const std::vector<std::optional<OperandPlace>>& kept,
               std::size_t registers) {
  std::vector<std::optional<OperandPlace>> meant(registers);  // the register that is read in place of another
  const auto is_needless = [&](MachineStep& step) {
    for (OperandPlace* operand : {&step.left, &step.right}) {
      const std::optional<OperandPlace>* other = nullptr;
      if (is_constant(*operand)) other = &kept[operand->number];
      if (is_register(*operand)) other = &meant[operand->number];
      if (other != nullptr && *other) *operand = **other;
    }
    if (is_register(step.result)) meant[step.result.number].reset();
    const bool is_load = step.operation == VectorOperation::copy && is_register(step.result) && is_register(step.left);
    if (is_load) meant[step.result.number] = step.left;
    return is_load;
  };
  // One after the other: the content of a register depends on the steps before.
  auto end = steps.begin();
  for (MachineStep& step : steps) {
    if (!is_needless(step)) *end++ = step;
  }
  steps.erase(end, steps.end());
}

/// Registers that no step uses get constants, once for all intervals.
void keep_constants(MachineSteps& machine, std::size_t values, std::size_t registers) {
  std::uint32_t first_unused = 0;
  for (MachineStep& step : machine.steps) {
    for (const OperandPlace* place : places_of(step)) {
      if (is_register(*place)) first_unused = std::max(first_unused, place->number + 1);
    }
  }
  std::vector<std::uint32_t> constants = constants_by_use(machine.steps, values);
  constants.resize(std::min(constants.size(), registers - first_unused));
  std::vector<std::optional<OperandPlace>> kept(values);
  for (std::size_t i = 0; i < constants.size(); ++i) {
    const OperandPlace place{OperandPlace::Kind::in_register, first_unused + static_cast<std::uint32_t>(i)};
    kept[constants[i]] = place;
    machine.once.push_back({VectorOperation::copy, place, {OperandPlace::Kind::constant, constants[i]}, {}});
  }
  read_kept(machine.steps, kept, registers);
}

}  // namespace

MachineSteps allocate_registers(const NativeStage& stage, const std::vector<NativePlan::Home>& homes,
                                std::size_t registers) {
  const std::vector<VectorStep> steps = overlapping_order(stage.arithmetic, homes.size(), registers);
  MachineSteps machine = RegisterAllocator(steps, homes, registers).allocate();
  keep_constants(machine, homes.size(), registers);
  return machine;
}

}  // namespace dmocbench
