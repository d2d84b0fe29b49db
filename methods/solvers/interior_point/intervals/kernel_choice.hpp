// Included by segment_kernel.cpp alone, see lanes.hpp.

template <class S>
std::size_t numbers_of_workspace(const EliminationPlan& plan) {
  return static_cast<std::size_t>(Workspace<S>::size(plan, shape_of<S>(plan))) * lane_count;
}

template <class S>
constexpr SegmentKernel kernel_of() {
  return {numbers_of_workspace<S>, sweep_backward<S>, sweep_forward<S>};
}

/// The first of the fixed shapes that fits, or the kernel for any.
template <class First, class... Rest>
SegmentKernel choose(const Shape& shape) {
  if (First::fits(shape)) return kernel_of<First>();
  if constexpr (sizeof...(Rest) > 0) {
    return choose<Rest...>(shape);
  } else {
    return kernel_of<Shape>();
  }
}

/// DMOCBENCH_ANY_SIZE is 1 for processors of more than ten years ago: the compiler is spared a minute.
inline SegmentKernel choose_kernel([[maybe_unused]] const Shape& shape) {
#if DMOCBENCH_ANY_SIZE
  return kernel_of<Shape>();
#else
  // The midpoint rule for n = 1, 2 and 3 configurations, DMOC and collocation; with fewer controls than configurations
  // and with as many, some also with a free horizon.
  return choose<FixedShape<2, 2, 0, 1, 2>, FixedShape<4, 0, 0, 1, 4>,  //
                FixedShape<2, 2, 0, 2, 2>, FixedShape<4, 0, 0, 2, 4>,  //
                FixedShape<1, 1, 0, 1, 1>, FixedShape<2, 0, 0, 1, 2>,  //
                FixedShape<3, 3, 0, 2, 3>, FixedShape<6, 0, 0, 2, 6>,  //
                FixedShape<3, 3, 0, 3, 3>, FixedShape<6, 0, 0, 3, 6>,  //
                FixedShape<2, 2, 1, 1, 2>, FixedShape<4, 0, 1, 1, 4>,  //
                FixedShape<2, 2, 1, 2, 2>, FixedShape<4, 0, 1, 2, 4>,  //
                FixedShape<3, 3, 1, 3, 3>, FixedShape<6, 0, 1, 3, 6> >(shape);
#endif
}
