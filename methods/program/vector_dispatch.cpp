#include "methods/program/processor.hpp"
#include "methods/program/vector_loops.hpp"

namespace dmocbench {

std::vector<const VectorLoops*> available_vector_loops() {
  std::vector<const VectorLoops*> loops{&vector_loops_baseline};
#ifdef DMOCBENCH_X86_KERNELS
  if (has_avx2()) loops.push_back(&vector_loops_avx2);
  if (has_avx512()) loops.push_back(&vector_loops_avx512);
#endif
  return loops;
}

namespace {

/// Found without a list, which would take memory where evaluations must not.
const VectorLoops& widest_vector_loops() {
#ifdef DMOCBENCH_X86_KERNELS
  if (has_avx512()) return vector_loops_avx512;
  if (has_avx2()) return vector_loops_avx2;
#endif
  return vector_loops_baseline;
}

}  // namespace

const VectorLoops& vector_loops() {
  static const VectorLoops& widest = widest_vector_loops();
  return widest;
}

}  // namespace dmocbench
