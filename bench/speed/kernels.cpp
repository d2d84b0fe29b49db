#include "bench/speed/kernels.hpp"

namespace dmocbench::speed {

namespace kernels_baseline {
Kernels all();
}
namespace kernels_avx2 {
Kernels all();
}
namespace kernels_avx512 {
Kernels all();
}

Kernels kernels_of(InstructionSet set) {
#ifdef DMOCBENCH_X86_KERNELS
  static constexpr std::array kernels{kernels_baseline::all, kernels_avx2::all, kernels_avx512::all};
#else
  static constexpr std::array kernels{kernels_baseline::all};
#endif
  return compiled_for(set, kernels)();
}

}  // namespace dmocbench::speed
