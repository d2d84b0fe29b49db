#pragma once

#include <cstddef>
#include <type_traits>

#include "methods/kkt/intervals/pass_kernel.hpp"
#include "methods/kkt/intervals/pass_step.hpp"
#include "methods/kkt/intervals/segment_sweeps.hpp"

// NOLINTBEGIN(*-reinterpret-cast,*-member-init*,*-identifier-naming,*-avoid-c-arrays,*-implicit-widening*): memory of
// the caller, as numbers
namespace dmocbench::kkt {
inline namespace DMOCBENCH_LANES {

/// The plan and the memory of a single pass.
template <class S>
struct PassSweep {
  PassSweep(const EliminationPlan& the_plan, double* workspace)
      : plan(the_plan), shape(shape_of<S>(plan)), memory{reinterpret_cast<Lanes*>(workspace)} {
    const auto numbers = [&](int count) { return reinterpret_cast<double*>(memory.take((count + 7) / 8)); };
    work = numbers(PassWorkBlocks<S>{shape}.size());
    forward = numbers(PassForwardBlocks<S>{shape}.size());
    input_size = whole_quads(PassInputBlocks<S>{shape}.size());
    inputs = numbers(input_size * lane_count);
    next_E = numbers(node_height(shape) * shape.node);
    size = memory.taken;
  }

  [[nodiscard]] double* record(const Pass& pass, int interval) const {
    return pass.records + std::ptrdiff_t{interval} * whole_quads(PassRecordBlocks<S>{shape}.size());
  }
  [[nodiscard]] double* end_record(const Pass& pass, int interval) const {
    return pass.end_records + std::ptrdiff_t{interval} * whole_quads(PassEndBlocks<S>{shape}.size());
  }

  const EliminationPlan& plan;
  S shape;
  Memory memory;
  double* work;
  double* forward;
  double* inputs;  // `PassInputBlocks` of eight intervals
  int input_size;
  double* next_E;  // factors of the equalities of the interval after them
  int size;
};

/// The entries of an array that the intervals of a horizon of fewer than eight read, then copies of the last one.
inline const double* read_few(const PassGather::Term& term, const double* array, int intervals,
                              double (&numbers)[lane_count]) {
  for (int lane = 0; lane < lane_count; ++lane) {
    const int entry = (lane < intervals ? lane : intervals - 1) - (term.from_before ? 1 : 0);
    numbers[lane] = entry >= 0 ? array[entry] : 0.0;
  }
  return numbers;
}

/// Fills the input of the intervals `begin` to `begin` + `count` - 1, at most eight. Entries are gathered for all of
/// them, and turned four at a time.
inline void gather_inputs(const NewtonArrays& arrays, int begin, int count, const Pass& pass, double* inputs,
                          std::ptrdiff_t distance) {
  const bool has_few = pass.intervals < lane_count;
  Quad sums[2][4] = {};
  for (int g = 0; g < pass.gather_count; ++g) {
    const PassGather& item = pass.gathers[g];
#pragma GCC unroll 4
    for (int r = 0; r < 4; ++r) {
      const PassGather::Term& term = item.terms[static_cast<std::size_t>(r)];
      const double* const array = arrays.of(term.source) + term.first;
      const double* numbers = array + begin - (term.from_before ? 1 : 0);
      // The block that comes next: these are more places in memory than the processor follows by itself.
      __builtin_prefetch(numbers - lane_count);
      double few[lane_count];
      if (has_few) numbers = read_few(term, array, pass.intervals, few);
      const bool lacks_first = begin == 0 && term.from_before && !has_few;
      for (int half = 0; half < 2; ++half) {
        Quad four;
        __builtin_memcpy(&four, half == 0 && lacks_first ? array : numbers + 4 * half, sizeof four);
        if (half == 0 && lacks_first) four = __builtin_shufflevector(four, Quad{}, 4, 0, 1, 2);
        sums[half][r] += term.sign * four;
      }
    }
    if (!item.is_last) continue;
    for (int half = 0; half < 2; ++half) {
      transpose(sums[half]);
      for (int c = 0; c < 4; ++c) {
        if (4 * half + c < count) quad(inputs + item.slot + (4 * half + c) * distance) = sums[half][c];
        sums[half][c] = Quad{};
      }
    }
  }
}

/// The input of the intervals `begin` to `begin` + `count` - 1, at most eight, and what of their records depends on
/// no others but the next.
template <class S>
[[gnu::noinline]] void prepare_intervals(const PassSweep<S>& sweep, const NewtonArrays& arrays, int begin, int count,
                                         Pass& pass) {
  // Squares are added to entries that nothing is gathered for.
  for (int i = 0; sweep.shape.inequalities > 0 && i < count * sweep.input_size; ++i) sweep.inputs[i] = 0.0;
  gather_inputs(arrays, begin, count, pass, sweep.inputs, sweep.input_size);
  const int E_size = node_height(sweep.shape) * sweep.shape.node;
  const double* next_E = begin + count < pass.intervals ? sweep.next_E : nullptr;
  for (int interval = begin + count - 1; interval >= begin; --interval) {
    double* const input = sweep.inputs + (interval - begin) * sweep.input_size;
    if (interval + 1 == pass.intervals) drop_terms_of_next(sweep.shape, input);
    for (int i = 0; i < pass.unit_count; ++i) input[pass.unit_slots[i]] = 1.0;
    add_squares(sweep.shape, input);
    double* const E = input + PassInputBlocks<S>{sweep.shape}.equality().first;
    const double ratio = factorise_equalities(sweep.shape, sweep.plan.pivot_scales.data(), E);
    pass.smallest_ratio = ratio >= pass.smallest_ratio ? pass.smallest_ratio : ratio;
    record_equalities(sweep.shape, input, next_E, pass.places_of_rows, sweep.record(pass, interval));
    next_E = E;
  }
  for (int i = 0; i < E_size; ++i) sweep.next_E[i] = next_E[i];
}

inline std::size_t pass_workspace_size(const EliminationPlan& plan) {
  return static_cast<std::size_t>(PassSweep<Shape>(plan, nullptr).size) * lane_count;
}

template <class S>
void start_pass(const EliminationPlan& plan, const double* last_sums, Pass& pass) {
  const PassSweep<S> sweep(plan, pass.workspace);
  const S shape = sweep.shape;
  const int n = shape.node;
  const PassValueBlocks<S> values{shape};
  for (int i = 0; i < values.size(); ++i) pass.value[i] = 0.0;
  for (int i = 0; i < 2 * n; ++i) pass.value[values.extras()(i, 1 + i)] = 1.0;
  for (int i = 0; i < n; ++i) pass.value[values.reachability()(n + i, 0)] = -last_sums[i];
  for (int i = 0; i < PassForwardBlocks<S>{shape}.size(); ++i) sweep.forward[i] = 0.0;
  pass.state = sweep.forward;
  pass.prepared = pass.intervals;
  pass.smallest_ratio = 1e300;
  pass.pivots_hold = true;
  pass.is_negative = false;
}

template <class S, bool has_end>
[[gnu::noinline]] void eliminate_prepared(const PassSweep<S>& sweep, int begin, int end, Pass& pass) {
  const S shape = sweep.shape;
  PassSigns signs;
  for (int interval = end - 1; interval >= begin && signs.hold; --interval) {
    pass_backward<S, has_end>(shape, sweep.inputs + (interval - pass.prepared) * sweep.input_size,
                              sweep.record(pass, interval), sweep.end_record(pass, interval), pass.value, sweep.work,
                              signs);
  }
  pass.pivots_hold = signs.hold;
  pass.is_negative = signs.is_negative;
}

/// Few intervals carry ν: knowing many unknowns gains little and takes long to compile.
template <class S>
using ForFewIntervals = std::conditional_t<(known_nodes<S> <= 4), S, Shape>;

template <class S>
void pass_backward_sweep(const EliminationPlan& plan, const NewtonArrays& arrays, int begin, int end, bool carries_nu,
                         Pass& pass) {
  using Carrying = ForFewIntervals<S>;
  const PassSweep<S> sweep(plan, pass.workspace);
  const PassSweep<Carrying> carrying(plan, pass.workspace);
  while (end > begin && pass.pivots_hold) {
    if (end == pass.prepared) {
      const int count = end < lane_count ? end : lane_count;
      prepare_intervals(sweep, arrays, end - count, count, pass);
      pass.prepared = end - count;
    }
    const int first = begin > pass.prepared ? begin : pass.prepared;
    if (carries_nu) {
      eliminate_prepared<Carrying, true>(carrying, first, end, pass);
    } else {
      eliminate_prepared<S, false>(sweep, first, end, pass);
    }
    end = first;
  }
}

template <class S>
void pass_forward_sweep(const EliminationPlan& plan, const Pass& pass, int begin, int end, const double* nu,
                        double* primal_step, double* multiplier_step) {
  const PassSweep<S> sweep(plan, pass.workspace);
  for (int interval = begin; interval < end; ++interval) {
    pass_forward(sweep.shape, sweep.record(pass, interval), sweep.end_record(pass, interval), nu, sweep.forward);
    for (int i = 0; i < pass.scatter_count; ++i) {
      const Scatter& item = pass.scatters[i];
      (item.is_multiplier ? multiplier_step : primal_step)[item.first + interval] = sweep.forward[item.index];
    }
  }
}

template <class S>
constexpr PassKernel pass_kernel_of() {
  return {pass_workspace_size, start_pass<Shape>, pass_backward_sweep<S>, pass_forward_sweep<S>};
}

/// The kernel of the fixed shape that fits, or the one for any shape.
template <class... FixedShapes>
PassKernel choose_pass([[maybe_unused]] const Shape& shape) {
  PassKernel kernel = pass_kernel_of<Shape>();
  static_cast<void>(((FixedShapes::fits(shape) && (kernel = pass_kernel_of<FixedShapes>(), true)) || ...));
  return kernel;
}

}  // namespace DMOCBENCH_LANES
}  // namespace dmocbench::kkt
// NOLINTEND(*-reinterpret-cast,*-member-init*,*-identifier-naming,*-avoid-c-arrays,*-implicit-widening*)
