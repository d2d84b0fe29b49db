#include "bench/structure_advantage/counting_kernel.hpp"

#include <cstddef>
#include <type_traits>

#define DMOCBENCH_INLINE inline
#define DMOCBENCH_ANY_SIZE 0

namespace dmocbench::interior_point::counting {

namespace uncounted {
#include "methods/runtime/lanes.inc"
}  // namespace uncounted

struct Counts {
  long long multiplications = 0;
  long long divisions = 0;
  long long additions = 0;
};

Counts counts;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): operators have nowhere else to count

/// Eight numbers, whose operations are counted once for all eight.
struct Lanes {
  using Vector = uncounted::Lanes::Vector;
  using Mask = uncounted::Lanes::Mask;

  Vector v;

  static Lanes all(double value) { return {Vector{} + value}; }

  friend Lanes operator+(const Lanes& a, const Lanes& b) { return counted(counts.additions, a.v + b.v); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return counted(counts.additions, a.v - b.v); }
  friend Lanes operator-(const Lanes& a) { return {-a.v}; }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return counted(counts.multiplications, a.v * b.v); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return counted(counts.divisions, a.v / b.v); }
  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator-=(const Lanes& b) { return *this = *this - b; }

 private:
  static Lanes counted(long long& count, const Vector& result) {
    ++count;
    return {result};
  }
};

Lanes chosen(const Lanes::Mask& mask, const Lanes& yes, const Lanes& no) { return {mask ? yes.v : no.v}; }
Lanes smaller(const Lanes& a, const Lanes& b) { return {a.v < b.v ? a.v : b.v}; }
Lanes larger(const Lanes& a, const Lanes& b) { return {a.v > b.v ? a.v : b.v}; }
Lanes least_so_far(const Lanes& so_far, const Lanes& value) {
  return {uncounted::least_so_far({so_far.v}, {value.v}).v};
}
Lanes magnitude(const Lanes& a) { return larger(a, -a); }
void transpose(Lanes::Vector (&rows)[8]) {  // NOLINT(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
  uncounted::transpose(rows);
}

#include "methods/solvers/interior_point/intervals/collect.inc"
//
#include "methods/solvers/interior_point/intervals/backward_step.inc"
//
#include "methods/solvers/interior_point/intervals/records.inc"
//
#include "methods/solvers/interior_point/intervals/backward_sweep.inc"
//
#include "methods/solvers/interior_point/intervals/forward_sweep.inc"
//
#include "methods/solvers/interior_point/intervals/kernel_choice.inc"

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): a kernel is a plain function
SweepCount last_sweep;
SegmentKernel chosen_kernel;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

void counted_backward(const EliminationPlan& plan, const NewtonArrays& arrays, SegmentGroup& group) {
  counts = {};
  chosen_kernel.backward(plan, arrays, group);
  const auto per_interval = [&](long long count) { return static_cast<double>(count) / group.steps; };
  last_sweep = {.multiplications = per_interval(counts.multiplications),
                .divisions = per_interval(counts.divisions),
                .additions = per_interval(counts.additions)};
}

}  // namespace dmocbench::interior_point::counting

namespace dmocbench {

interior_point::SegmentKernel counting_segment_kernel(const interior_point::Shape& shape) {
  interior_point::counting::chosen_kernel = interior_point::counting::choose_kernel(shape);
  interior_point::SegmentKernel kernel = interior_point::counting::chosen_kernel;
  kernel.backward = interior_point::counting::counted_backward;
  return kernel;
}

SweepCount last_sweep_count() { return interior_point::counting::last_sweep; }

}  // namespace dmocbench
