#include "methods/expression/native/native_code.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include <xbyak/xbyak.h>

#include "methods/expression/native/register_allocation.hpp"

namespace dmocbench {

namespace {

/// The vector registers of an instruction set.
struct VectorRegisters {
  Xbyak::Operand::Kind kind;
  std::size_t count;
  std::size_t bytes;  // of each

  [[nodiscard]] std::size_t width() const { return bytes / sizeof(double); }
};

constexpr VectorRegisters vector_registers_of(InstructionSet set) {
  if (set == InstructionSet::avx512) return {Xbyak::Operand::ZMM, 32, 64};
  return {Xbyak::Operand::YMM, 16, 32};
}

/// Writes functions void(double* const* series, std::size_t width) by the calling convention of System V, and after
/// them the constants that they read.
class StageWriter : public Xbyak::CodeGenerator {
 public:
  StageWriter(const NativePlan& plan, const VectorRegisters& registers)
      : CodeGenerator(expected_size(plan), Xbyak::AutoGrow),
        plan_(plan),
        registers_(registers),
        constants_(plan.homes.size()),
        is_read_(plan.homes.size()) {}

  /// Returns where the function begins.
  std::size_t write(const NativeStage& stage) {
    const MachineSteps machine = allocate_registers(stage, plan_.homes, registers_.count);
    align(cache_line);
    const std::size_t begin = getSize();
    reserve_stack(machine.stack_places);
    fetch_addresses(machine);
    for (const MachineStep& step : machine.once) write(step);
    shl(last_, 3);
    sub(last_, static_cast<std::uint32_t>(registers_.bytes));
    xor_(offset_, offset_);
    Xbyak::Label next_vector;
    Xbyak::Label end;
    L(next_vector);
    for (const MachineStep& step : machine.steps) write(step);
    cmp(offset_, last_);
    je(end, T_NEAR);
    add(offset_, static_cast<std::uint32_t>(registers_.bytes));
    cmp(offset_, last_);
    cmova(offset_, last_);
    jmp(next_vector, T_NEAR);
    L(end);
    vzeroupper();
    release_stack();
    ret();
    return begin;
  }

  /// To be called last: makes the code executable.
  void finish() {
    align(cache_line);
    for (std::size_t value = 0; value < constants_.size(); ++value) {
      const std::optional<double>& constant = plan_.homes[value].constant;
      if (!is_read_[value] || !constant) continue;
      L(constants_[value]);
      for (std::size_t lane = 0; lane < registers_.width(); ++lane) {
        dq(std::bit_cast<std::uint64_t>(*constant));
      }
    }
    readyRE();
  }

 private:
  static constexpr std::uint32_t cache_line = 64;

  /// Code that outgrows its memory is copied. Memory that is not written costs nothing.
  static std::size_t expected_size(const NativePlan& plan) {
    constexpr std::size_t page = 4096;
    constexpr std::size_t bytes_of_a_step = 24;
    std::size_t steps = 0;
    for (const NativeStage& stage : plan.stages) steps += stage.arithmetic.size();
    return (1 + steps * bytes_of_a_step / page) * page;
  }

  void reserve_stack(std::size_t places) {
    push(rbp);
    for (const Xbyak::Reg64& saved : saved_registers_) push(saved);
    mov(rbp, rsp);
    if (places == 0) return;
    and_(rsp, ~(cache_line - 1));
    sub(rsp, static_cast<std::uint32_t>(places * registers_.bytes));
  }
  void release_stack() {
    mov(rsp, rbp);
    for (std::size_t i = saved_registers_.size(); i-- > 0;) pop(saved_registers_[i]);
    pop(rbp);
  }

  /// Addresses of series are fetched once, the most used ones first, for as many as there are registers.
  void fetch_addresses(const MachineSteps& machine) {
    std::vector<std::pair<std::size_t, std::uint32_t>> uses;  // how often, and the series
    const auto count = [&](const OperandPlace& place) {
      if (place.kind != OperandPlace::Kind::series) return;
      if (place.number >= uses.size()) uses.resize(place.number + 1);
      ++uses[place.number].first;
    };
    for (const MachineStep& step : machine.steps) {
      count(step.result);
      count(step.left);
      if (operand_count(step.operation) > 1) count(step.right);
    }
    addresses_.assign(uses.size(), std::nullopt);
    for (std::uint32_t i = 0; i < uses.size(); ++i) uses[i].second = i;
    const std::size_t fetched = std::min(uses.size(), address_registers_.size());
    std::ranges::partial_sort(uses, uses.begin() + static_cast<std::ptrdiff_t>(fetched), std::greater<>());
    for (std::size_t i = 0; i < fetched && uses[i].first > 0; ++i) {
      addresses_[uses[i].second] = address_registers_[i];
      mov(address_registers_[i], ptr[series_ + uses[i].second * sizeof(double*)]);
    }
  }

  void write(const MachineStep& step) {
    const Xbyak::Xmm result = vector(step.result);
    const Xbyak::Xmm left = vector(step.left);
    switch (step.operation) {
      case VectorOperation::add:
        return with_right(step, [&](const auto& right) { vaddpd(result, left, right); });
      case VectorOperation::subtract:
        return with_right(step, [&](const auto& right) { vsubpd(result, left, right); });
      case VectorOperation::multiply:
        return with_right(step, [&](const auto& right) { vmulpd(result, left, right); });
      case VectorOperation::divide:
        return with_right(step, [&](const auto& right) { vdivpd(result, left, right); });
      case VectorOperation::exclusive_or:
        return with_right(step, [&](const auto& right) { vxorpd(result, left, right); });
      case VectorOperation::square_root:
        return vsqrtpd(result, left);
      case VectorOperation::copy:
        if (step.result.kind == OperandPlace::Kind::in_register) return vmovupd(result, memory(step.left));
        return vmovupd(memory(step.result), left);
    }
  }

  /// The right operand of arithmetic, in a register or in memory.
  template <class Write>
  void with_right(const MachineStep& step, const Write& write_instruction) {
    if (step.right.kind == OperandPlace::Kind::in_register) {
      write_instruction(vector(step.right));
    } else {
      write_instruction(memory(step.right));
    }
  }

  /// The register of an operand; any register if the operand is in memory.
  [[nodiscard]] Xbyak::Xmm vector(const OperandPlace& place) const {
    const bool is_register = place.kind == OperandPlace::Kind::in_register;
    return {registers_.kind, is_register ? static_cast<int>(place.number) : 0};
  }

  /// The address of a place other than a register. A series' address is fetched first, if it is in none.
  Xbyak::Address memory(const OperandPlace& place) {
    switch (place.kind) {
      case OperandPlace::Kind::series:
        if (const auto& address = addresses_[place.number]) return ptr[*address + offset_];
        mov(begin_, ptr[series_ + place.number * sizeof(double*)]);
        return ptr[begin_ + offset_];
      case OperandPlace::Kind::constant:
        is_read_[place.number] = true;
        return ptr[rip + constants_[place.number]];
      default:
        return ptr[rsp + place.number * registers_.bytes];
    }
  }

  const NativePlan& plan_;
  const VectorRegisters registers_;
  std::vector<Xbyak::Label> constants_;  // by values
  std::vector<bool> is_read_;            // whether code reads a constant
  const Xbyak::Reg64 series_ = rdi;      // the first argument
  const Xbyak::Reg64 last_ = rsi;        // the second one, which becomes the offset of the last vector
  const Xbyak::Reg64 offset_ = rax;      // of the present vector, in bytes
  const Xbyak::Reg64 begin_ = rdx;       // of a series
  const std::array<Xbyak::Reg64, 5> saved_registers_{rbx, r12, r13, r14, r15};  // the caller's
  const std::array<Xbyak::Reg64, 10> address_registers_{rcx, r8, r9, r10, r11, rbx, r12, r13, r14, r15};
  std::vector<std::optional<Xbyak::Reg64>> addresses_;  // by series: the register that has its address
};

}  // namespace

bool has_native_code(InstructionSet set) noexcept { return set != InstructionSet::baseline; }

std::unique_ptr<const NativeCode> make_native_code(const NativePlan& plan, InstructionSet set) {
  if (!has_native_code(set)) return nullptr;
  const VectorRegisters registers = vector_registers_of(set);
  auto code = std::make_unique<NativeCode>();
  try {
    const auto writer = std::make_shared<StageWriter>(plan, registers);
    std::vector<std::size_t> begins;
    begins.reserve(plan.stages.size());
    for (const NativeStage& stage : plan.stages) begins.push_back(writer->write(stage));
    writer->finish();
    for (std::size_t i = 0; i < begins.size(); ++i) {
      const auto address = reinterpret_cast<std::uintptr_t>(writer->getCode()) + begins[i];  // NOLINT: bytes become
      const auto arithmetic = reinterpret_cast<decltype(NativeCode::Stage::arithmetic)>(address);  // NOLINT: a function
      code->stages.push_back({arithmetic, plan.stages[i].functions});
    }
    code->memory = writer;
  } catch (const Xbyak::Error&) {
    return nullptr;
  }
  code->vector_width = registers.width();
  code->slots = plan.slots;
  return code;
}

}  // namespace dmocbench
