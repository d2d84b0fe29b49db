#pragma once

namespace dmocbench {

#ifdef DMOCBENCH_X86_KERNELS
/// Whether this processor has what a source that `dmocbench_kernel` (methods/CMakeLists.txt) compiled for a set needs.
[[nodiscard]] inline bool has_avx2() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }
[[nodiscard]] inline bool has_avx512() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
}
#endif

}  // namespace dmocbench
