#pragma once

#include <cstddef>
#include <type_traits>

#include "methods/kkt/intervals/elimination_step.hpp"
#include "methods/kkt/intervals/kernel_blocks.hpp"
#include "methods/kkt/intervals/kernel_gather.hpp"
#include "methods/kkt/intervals/segment_kernel.hpp"
#include "methods/kkt/intervals/shape.hpp"

// Both sweeps over a group. DMOCBENCH_ANY_SIZE is 1 where a source needs the kernel for any shape only: where
// processors usually have a wider instruction set, which saves a minute of compilation.
#ifndef DMOCBENCH_ANY_SIZE
#define DMOCBENCH_ANY_SIZE 0
#endif

// NOLINTBEGIN(*-reinterpret-cast,*-member-init): memory of the caller, as numbers
namespace dmocbench::kkt {
inline namespace DMOCBENCH_LANES {

template <class S>
S shape_of(const EliminationPlan& plan) {
  if constexpr (std::is_same_v<S, Shape>) {
    return plan.shape;
  } else {
    return S{plan.shape.inequalities};
  }
}

/// The plan, the arrays and the memory of both sweeps over a group.
template <class S>
struct Sweep {
  Sweep(const EliminationPlan& the_plan, const NewtonArrays& the_arrays, const SegmentGroup& the_group, Memory memory)
      : plan(the_plan),
        arrays(the_arrays),
        group(the_group),
        shape(shape_of<S>(plan)),
        cost_to_go{memory.take(size_of<CostToGo<S>>(shape))},
        step{memory.take(size_of<StepWork<S>>(shape))},
        forward(memory.take(ForwardBlocks<S>{shape}.size())),
        locals{memory.take(LocalBlocks<S>{shape}.size() * block_steps), LocalBlocks<S>{shape}.size()},
        outputs{memory.take(scatter_count() * block_steps), block_steps},
        size(memory.taken) {}

  [[nodiscard]] int scatter_count() const { return static_cast<int>(plan.scatters.size()); }

  // Records are made in chunks of steps.
  [[nodiscard]] int chunk_count() const { return (group.steps + group.recorded_steps - 1) / group.recorded_steps; }
  [[nodiscard]] int begin_of_chunk(int chunk) const { return chunk * group.recorded_steps; }
  [[nodiscard]] int end_of_chunk(int chunk) const {
    const int end = begin_of_chunk(chunk + 1);
    return end < group.steps ? end : group.steps;
  }
  [[nodiscard]] int value_size() const { return state_size(shape) * value_columns(shape); }
  /// P, p and Φ at the end of a chunk.
  [[nodiscard]] Lanes* checkpoint(int chunk) const {
    return reinterpret_cast<Lanes*>(group.checkpoints) + static_cast<std::ptrdiff_t>(chunk) * value_size();
  }
  /// The record of the i-th step of a chunk.
  [[nodiscard]] Lanes* record(int i) const {
    return reinterpret_cast<Lanes*>(group.records) + static_cast<std::ptrdiff_t>(i) * RecordBlocks<S>{shape}.size();
  }

  const EliminationPlan& plan;
  const NewtonArrays& arrays;
  const SegmentGroup& group;
  S shape;
  Memory cost_to_go;
  Memory step;
  Lanes* forward;             // `ForwardBlocks`
  MatrixView<Lanes> locals;   // local blocks x steps
  MatrixView<Lanes> outputs;  // steps x scattered numbers
  int size;                   // numbers of lanes in the workspace
};

/// The value at the end of a segment: ½ Σ ρ_i X_i² + νᵀX.
template <class S>
inline void start_cost_to_go(const S& shape, const SegmentGroup& group, const double* terminal_weights,
                             CostToGo<S>& V) {
  const int X = state_size(shape);
  for (int i = 0; i < X * value_columns(shape); ++i) V.value.data()[i] = Lanes{};
  for (int i = 0; i < X * reachability_columns(shape); ++i) V.reachability.data()[i] = Lanes{};
  for (int j = 0; j < X; ++j) {
    V.P(j, j) = group.is_interleaved ? load_lanes(terminal_weights + std::ptrdiff_t{j} * lane_count)
                                     : Lanes::all(terminal_weights[j]);
    V.Phi(j, j) = Lanes::all(1.0);
  }
  V.signs = PivotSigns{};
  V.smallest_ratio = Lanes::all(1e300);
}

/// The lanes that have an interval at a step.
inline Lanes::Mask active_at(const SegmentGroup& group, int step) {
  Lanes length;
  for (std::size_t lane = 0; lane < lane_count; ++lane) length.set(lane, group.length[lane]);
  return Lanes::all(step) < length;
}

inline double smallest_of(const Lanes& lanes) {
  double smallest = lanes[0];
  // A comparison that is false for NaN, so that NaN is found.
  for (std::size_t lane = 1; lane < lane_count; ++lane) smallest = lanes[lane] >= smallest ? smallest : lanes[lane];
  return smallest;
}

/// Whether a sweep continues: while for all segments, or for one instance at least, the remaining steps can change
/// the result of the pivots. `state`: how many entries a state has.
inline bool is_worth_while(const SegmentGroup& group, const PivotSigns& signs, int state) {
  if (group.is_interleaved) return smallest_of(-signs.hold) < 0.0;
  const Lanes::Mask are_few = signs.negative < Lanes::all(state + 1);
  return smallest_of(chosen(are_few, Lanes::all(1.0), signs.hold)) > 0.0;
}

/// The result of the pivots of all segments, and how many of each are negative.
inline void read_signs(const PivotSigns& signs, int state, SegmentGroup& group) {
  double negative = 0.0;
  bool has_too_many = false;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const double count = signs.negative[lane];
    has_too_many = has_too_many || (count > state && count < uncertain);
    negative += count;
  }
  if (smallest_of(signs.hold) > 0.0) {
    group.pivots = FreePivots::positive;
  } else if (has_too_many) {
    group.pivots = FreePivots::too_many_negative;
  } else if (negative < uncertain) {
    group.pivots = FreePivots::some_negative;
    for (std::size_t lane = 0; lane < lane_count; ++lane) group.negative[lane] = static_cast<int>(signs.negative[lane]);
  } else {
    group.pivots = FreePivots::near_zero;
  }
}

/// Eliminates the intervals of one step in front of the cost-to-go, and records the data for the forward sweep.
/// `active`: null if all lanes have an interval; the cost-to-go of lanes that have none stays.
template <class S>
DMOCBENCH_INLINE void step_backward(const LocalSystem<S>& local, const Lanes::Mask* active, CostToGo<S>& V,
                                    StepWork<S>& work, Lanes* record) {
  const S& shape = local.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  const RecordBlocks<S> places{shape};
  const PivotSigns signs_before = V.signs;
  const Lanes ratio_before = V.smallest_ratio;
  eliminate_equalities(local, V, work);
  make_transition(local, work, record);
  condense(local, active, V, work);
  factorise_free(shape, V, work);
  store_gain(shape, work, view(record, places.gain()));
  store_transition(shape, work, record);
  if (has_own_rows(shape)) {
    store_gradient(local, V, work, view(record, places.gradient()));
    const auto factors = view(record, places.factors());
    copy(work.equalities.data(), n * n, factors.first);
    copy(work.reciprocals.data(), n, &factors(0, n));
  }
  advance(shape, active, work, V);
  if (active != nullptr) {
    V.signs.keep_where_inactive(*active, signs_before);
    V.smallest_ratio = chosen(*active, V.smallest_ratio, ratio_before);
  }
  if (!has_own_rows(shape)) {
    // The multipliers of the rows of a node are the derivative of the cost-to-go with respect to s.
    const auto derivative = [&](int i, int j) { return V.value(shape.node + i, j); };
    copy_columns(derivative, 2 * X + 1, view(record, places.multipliers()));
  }
}

/// Eliminates a chunk of all segments, last step to first, in front of `cost_to_go`, as long as it is worth while.
/// `ahead` as in `gather`. Not inlined: both sweeps use it, and it is long.
template <class S>
[[gnu::noinline]] void eliminate_chunk(const Sweep<S>& sweep, int chunk, int ahead, CostToGo<S>& cost_to_go) {
  const S shape = sweep.shape;
  const int begin = sweep.begin_of_chunk(chunk);
  const int end = sweep.end_of_chunk(chunk);
  Memory memory = sweep.step;
  StepWork<S> work(shape, memory);
  CostToGo<S> V = cost_to_go;  // a copy that nothing else refers to can live in registers
  const bool has_shorter_lanes = sweep.group.shortest < sweep.group.steps;
  const Lanes::Mask active = active_at(sweep.group, sweep.group.steps - 1);
  // Whether to continue is tested before every block, and in segments of one block before every step.
  const bool is_one_block = sweep.group.steps <= block_steps;
  const auto goes_on = [&] { return is_worth_while(sweep.group, V.signs, state_size(shape)); };
  // Blocks are cut from the end; only the first may be shorter, so `read_block` stays inside the array.
  for (int last = end; last > begin && goes_on(); last -= block_steps) {
    const int first = last - block_steps > begin ? last - block_steps : begin;
    gather(sweep.plan, sweep.arrays, sweep.group, {first, last - first}, ahead, sweep.locals);
    for (int step = last - 1; step >= first; --step) {
      if (is_one_block && !goes_on()) break;
      const bool has_all_lanes = !has_shorter_lanes || step < sweep.group.steps - 1;
      const LocalSystem<S> local(shape, sweep.plan, &sweep.locals(0, step - first));
      step_backward(local, has_all_lanes ? nullptr : &active, V, work, sweep.record(step - begin));
    }
  }
  cost_to_go = V;
}

/// Entries of the local blocks that nothing is gathered for keep these values.
template <class S>
inline void write_constants(const Sweep<S>& sweep) {
  for (int step = 0; step < block_steps; ++step) {
    for (int i = 0; i < sweep.locals.rows; ++i) sweep.locals(i, step) = Lanes{};
    for (const int entry : sweep.plan.unit_entries) sweep.locals(entry, step) = Lanes::all(1.0);
  }
}

template <class S>
void sweep_backward(const EliminationPlan& plan, const NewtonArrays& arrays, SegmentGroup& group) {
  const Sweep<S> sweep(plan, arrays, group, {reinterpret_cast<Lanes*>(group.workspace)});
  const S shape = sweep.shape;
  const int X = state_size(shape);
  if (!group.has_constants) {
    write_constants(sweep);
    group.has_constants = true;
  }
  Memory memory = sweep.cost_to_go;
  CostToGo<S> V(shape, memory);
  start_cost_to_go(shape, group, arrays.terminal_weights, V);
  const int chunks = sweep.chunk_count();
  for (int chunk = chunks - 1; chunk >= 0; --chunk) {
    if (chunks > 1) copy(V.value.data(), sweep.value_size(), sweep.checkpoint(chunk));
    eliminate_chunk(sweep, chunk, chunks > 1 ? -block_steps : 0, V);
  }
  read_signs(V.signs, X, group);
  group.smallest_ratio = smallest_of(V.smallest_ratio);
  if (group.is_interleaved) {
    __builtin_memcpy(group.lane_pivots_hold.data(), &V.signs.hold, sizeof V.signs.hold);
    __builtin_memcpy(group.lane_smallest_ratio.data(), &V.smallest_ratio, sizeof V.smallest_ratio);
  } else if (group.pivots != FreePivots::positive && group.pivots != FreePivots::some_negative) {
    return;
  }
  copy(V.value.data(), sweep.value_size(), reinterpret_cast<Lanes*>(group.value));
  const MatrixView<Lanes> reachability{reinterpret_cast<Lanes*>(group.reachability), X};
  for (int j = 0; j < X; ++j) {
    reachability(j, 0) = V.gamma(j);
    for (int i = 0; i < X; ++i) reachability(i, 1 + j) = i < j ? V.Gamma(j, i) : V.Gamma(i, j);
  }
}

/// The steps of a chunk, whose records are there, from the state in `sweep.forward`, which then is the state of the
/// next one.
template <class S>
void substitute_chunk(const Sweep<S>& sweep, int chunk, double* primal_step, double* multiplier_step) {
  const S shape = sweep.shape;
  const ForwardBlocks<S> results{shape};
  Lanes* const work = sweep.forward;
  const int begin = sweep.begin_of_chunk(chunk);
  const int end = sweep.end_of_chunk(chunk);
  const auto* nu = reinterpret_cast<const Lanes*>(sweep.group.multiplier);
  for (int first = begin; first < end; first += block_steps) {
    const int count = first + block_steps <= end ? block_steps : end - first;
    for (int step = 0; step < count; ++step) {
      step_forward(shape, sweep.record(first + step - begin), nu, work);
      Lanes* output = &sweep.outputs(step, 0);
      for (const Scatter& item : sweep.plan.scatters) {
        *output = work[item.index];
        output += block_steps;
      }
      for (int i = 0; i < state_size(shape); ++i) {
        work[results.columns()(free_size(shape) + i, 0)] = work[results.next_state()(i, 0)];
      }
    }
    const Lanes* output = &sweep.outputs(0, 0);
    for (const Scatter& item : sweep.plan.scatters) {
      double* const step = item.is_multiplier ? multiplier_step : primal_step;
      if (sweep.group.is_interleaved) {
        __builtin_memcpy(step + (item.first + first) * lane_count, output,
                         static_cast<std::size_t>(count) * sizeof(Lanes));
      } else {
        write_block(output, sweep.group, {first, count}, step + item.first);
      }
      output += block_steps;
    }
  }
}

template <class S>
void sweep_forward(const EliminationPlan& plan, const NewtonArrays& arrays, const SegmentGroup& group,
                   double* primal_step, double* multiplier_step) {
  const Sweep<S> sweep(plan, arrays, group, {reinterpret_cast<Lanes*>(group.workspace)});
  const S shape = sweep.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  for (int i = 0; i < X; ++i) sweep.forward[w + i] = reinterpret_cast<const Lanes*>(group.state)[i];
  sweep.forward[w + X] = Lanes::all(1.0);
  for (int chunk = 0; chunk < sweep.chunk_count(); ++chunk) {
    // The backward sweep has left the records of the first chunk.
    if (chunk > 0) {
      Memory memory_of_value = sweep.cost_to_go;
      CostToGo<S> V(shape, memory_of_value);
      start_cost_to_go(shape, group, arrays.terminal_weights, V);
      copy(sweep.checkpoint(chunk), sweep.value_size(), V.value.data());
      eliminate_chunk(sweep, chunk, group.recorded_steps, V);
    }
    substitute_chunk(sweep, chunk, primal_step, multiplier_step);
  }
}

template <class S>
std::size_t workspace_size(const EliminationPlan& plan) {
  return static_cast<std::size_t>(Sweep<S>(plan, {}, {}, {nullptr}).size) * lane_count;
}

template <class S>
constexpr SegmentKernel kernel_of() {
  return {workspace_size<S>, sweep_backward<S>, sweep_forward<S>};
}

/// The kernel of the fixed shape that fits, or the one for any shape.
template <class... FixedShapes>
SegmentKernel choose([[maybe_unused]] const Shape& shape) {
  SegmentKernel kernel = kernel_of<Shape>();
  static_cast<void>(((FixedShapes::fits(shape) && (kernel = kernel_of<FixedShapes>(), true)) || ...));
  return kernel;
}

inline SegmentKernel choose_kernel(const Shape& shape) {
#if DMOCBENCH_ANY_SIZE
  return choose<>(shape);
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
                FixedShape<3, 3, 1, 3, 3>, FixedShape<6, 0, 1, 3, 6>>(shape);
#endif
}

}  // namespace DMOCBENCH_LANES
}  // namespace dmocbench::kkt
// NOLINTEND(*-reinterpret-cast,*-member-init)
