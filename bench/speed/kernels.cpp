#include "bench/speed/kernels.hpp"

#include <string>

#include "methods/error.hpp"

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
  switch (set) {
    case InstructionSet::baseline:
      return kernels_baseline::all();
#ifdef DMOCBENCH_X86_KERNELS
    case InstructionSet::avx2:
      return kernels_avx2::all();
    case InstructionSet::avx512:
      return kernels_avx512::all();
#endif
    default:
      throw Error("no kernels for the instruction set " + std::string(name_of(set)));
  }
}

}  // namespace dmocbench::speed
