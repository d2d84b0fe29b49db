#include "methods/expression/instruction_set.hpp"

#include <cstdlib>
#include <string>

#include "methods/error.hpp"

namespace dmocbench {

std::string_view name_of(InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::baseline:
      return "baseline";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
  }
  return "unknown";
}

const std::vector<InstructionSet>& available_instruction_sets() {
  static const std::vector<InstructionSet> available = [] {
    std::vector<InstructionSet> sets{InstructionSet::baseline};
#ifdef DMOCBENCH_X86_KERNELS
    if (static_cast<bool>(__builtin_cpu_supports("avx2")) && static_cast<bool>(__builtin_cpu_supports("fma"))) {
      sets.push_back(InstructionSet::avx2);
      if (static_cast<bool>(__builtin_cpu_supports("avx512f")) &&
          static_cast<bool>(__builtin_cpu_supports("avx512dq")) &&
          static_cast<bool>(__builtin_cpu_supports("avx512cd")) &&
          static_cast<bool>(__builtin_cpu_supports("avx512bw"))) {
        sets.push_back(InstructionSet::avx512);
      }
    }
#endif
    return sets;
  }();
  return available;
}

InstructionSet preferred_instruction_set() {
  const char* wanted = std::getenv("DMOCBENCH_INSTRUCTION_SET");  // NOLINT(concurrency-mt-unsafe): only read
  if (wanted == nullptr) return available_instruction_sets().back();
  std::string names;
  for (const InstructionSet set : available_instruction_sets()) {
    if (name_of(set) == wanted) return set;
    names += names.empty() ? "" : ", ";
    names += name_of(set);
  }
  throw Error("DMOCBENCH_INSTRUCTION_SET=" + std::string(wanted) + " is not available here; choose one of " + names);
}

}  // namespace dmocbench
