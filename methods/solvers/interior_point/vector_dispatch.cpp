#include "methods/solvers/interior_point/processor.hpp"
#include "methods/solvers/interior_point/vector_loops.hpp"

namespace dmocbench::interior_point {

std::vector<const VectorLoops*> available_vector_loops() {
  std::vector<const VectorLoops*> loops{&vector_loops_baseline};
#ifdef DMOCBENCH_X86_KERNELS
  if (has_avx2()) loops.push_back(&vector_loops_avx2);
  if (has_avx512()) loops.push_back(&vector_loops_avx512);
#endif
  return loops;
}

const VectorLoops& vector_loops() {
  static const VectorLoops& widest = *available_vector_loops().back();
  return widest;
}

}  // namespace dmocbench::interior_point
