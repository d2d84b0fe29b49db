#include "methods/runtime/instruction_set.hpp"

#include <cstdlib>

#include "methods/choose.hpp"

namespace dmocbench {

namespace {

constexpr std::array every_set{InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512};

/// The number of sets of `every_set` that this processor can run: those whose instructions the flags of
/// `dmocbench_kernel` allow.
std::size_t count_of_sets() {
#ifdef DMOCBENCH_X86_KERNELS
  // The type is bool in clang, int in GCC.
  const auto all = [](auto... supported) { return (static_cast<bool>(supported) && ...); };
  if (!all(__builtin_cpu_supports("avx2"), __builtin_cpu_supports("fma"))) return 1;
  const bool has_avx512 = all(__builtin_cpu_supports("avx512f"), __builtin_cpu_supports("avx512dq"),
                              __builtin_cpu_supports("avx512cd"), __builtin_cpu_supports("avx512bw"));
  return has_avx512 ? 3 : 2;
#else
  return 1;
#endif
}

}  // namespace

std::string_view name_of(InstructionSet set) noexcept {
  constexpr std::array<std::string_view, every_set.size()> names{"baseline", "avx2", "avx512"};
  return names.at(static_cast<std::size_t>(set));
}

std::span<const InstructionSet> available_instruction_sets() {
  static const std::size_t count = count_of_sets();
  return std::span(every_set).first(count);
}

InstructionSet preferred_instruction_set() {
  const auto available = available_instruction_sets();
  const char* wanted = std::getenv("DMOCBENCH_INSTRUCTION_SET");  // NOLINT(concurrency-mt-unsafe): only read
  if (wanted == nullptr) return available.back();
  return one_of(available, name_of, wanted, "DMOCBENCH_INSTRUCTION_SET: this machine does not support");
}

}  // namespace dmocbench
