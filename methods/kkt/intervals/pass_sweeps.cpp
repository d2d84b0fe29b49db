// Compiled once per instruction set, each time with names of its own.
#include "methods/kkt/intervals/pass_sweeps.hpp"

namespace dmocbench::kkt {

PassKernel DMOCBENCH_PASS_KERNEL(const Shape& shape) {
#if DMOCBENCH_ANY_SIZE
  return choose_pass<>(shape);
#else
  // DMOC with the midpoint rule, with as many controls as configurations and with fewer.
  return choose_pass<FixedShape<1, 1, 0, 1, 1>, FixedShape<2, 2, 0, 1, 2>, FixedShape<2, 2, 0, 2, 2>,
                     FixedShape<3, 3, 0, 2, 3>, FixedShape<3, 3, 0, 3, 3>, FixedShape<4, 4, 0, 4, 4>,
                     FixedShape<6, 6, 0, 6, 6>, FixedShape<8, 8, 0, 8, 8> >(shape);
#endif
}

}  // namespace dmocbench::kkt
