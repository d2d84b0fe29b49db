#pragma once

#include <cstddef>
#include <type_traits>

#include "methods/kkt/intervals/elimination_step.hpp"
#include "methods/kkt/intervals/kernel_gather.hpp"
#include "methods/kkt/intervals/pass_kernel.hpp"
#include "methods/kkt/intervals/pass_step.hpp"
#include "methods/kkt/intervals/segment_sweeps.hpp"

// NOLINTBEGIN(*-reinterpret-cast,*-member-init,*-identifier-naming): memory of the caller, as numbers
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
    cost_size = whole_quads(PassCostBlocks<S>{shape}.size());
    costs = numbers(cost_size * lane_count);
    locals = memory.take(LocalBlocks<S>{shape}.size());
    next_inverse = memory.take(shape.node * shape.node);
    const auto [n, Z, X, w, N] = sizes_of(shape);
    hessian = memory.take(Z * (Z + X + 1));
    of_node = memory.take(shape.inequalities > 0 ? n * (n + 1) : 0);
    sums = memory.take(shape.node * (shape.node + free_size(shape)));
    local_memory = {memory.take(size_of<StepWork<Shape>>(plan.shape) + size_of<CostToGo<Shape>>(plan.shape))};
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
  double* costs;  // `PassCostBlocks` of eight intervals
  int cost_size;
  Lanes* locals;        // `LocalBlocks` of eight intervals
  Lanes* next_inverse;  // of the equalities of the intervals after them
  Lanes* hessian;       // of the local blocks, changed
  Lanes* of_node;       // the squares' Hessian and gradient of x
  Lanes* sums;
  Memory local_memory;
  int size;
};

/// Fills the local blocks of the intervals `begin` to `begin` + 7, in the lanes; those after the last repeat it.
inline void gather_neighbours(const EliminationPlan& plan, const NewtonArrays& arrays, int begin, int intervals,
                              Lanes* locals) {
  for (const Gather& item : plan.gathers) {
    const int lag = item.from_before ? 1 : 0;
    const double* const array = arrays.of(item.source) + item.first;
    Lanes numbers;
    // The block that comes next: these are more places in memory than the processor follows by itself.
    __builtin_prefetch(array + begin - lane_count);
    if (begin >= lag && begin + lane_count <= intervals) {
      numbers = load_lanes(array + begin - lag);
    } else {
      for (int lane = 0; lane < lane_count; ++lane) {
        const int interval = (begin + lane < intervals ? begin + lane : intervals - 1) - lag;
        numbers.set(static_cast<std::size_t>(lane), interval >= 0 ? array[interval] : 0.0);
      }
    }
    if (item.adds) numbers += locals[item.slot];
    locals[item.slot] = numbers;
    locals[item.mirror] = numbers;
  }
}

/// Puts a column whose i-th entry of all lanes is `entry(i)` to each lane's own place, `distance` numbers apart; zeros
/// after the last of `rows`.
template <class Entry>
DMOCBENCH_INLINE void put_column(int rows, int lanes, const Entry& entry, double* to, std::ptrdiff_t distance) {
#pragma GCC unroll 4
  for (int i = 0; i < rows; i += 4) {
    Lanes four[4];
#pragma GCC unroll 4
    for (int r = 0; r < 4; ++r) four[r] = i + r < rows ? entry(i + r) : Lanes{};
    for (int half = 0; half < lanes; half += 4) {
      Quad block[4];
      for (int r = 0; r < 4; ++r) block[r] = quad(reinterpret_cast<const double*>(&four[r]) + half);
      transpose(block);
      for (int c = 0; c < 4; ++c) {
        if (half + c < lanes) quad(to + i + (half + c) * distance) = block[c];
      }
    }
  }
}

/// Adds an inequality whose slack is eliminated, its square weighted by 1/e: to the Hessian between (Z, x, 1) in the
/// local blocks where they have it, else to `of_node` = x x (x, 1).
template <class S>
DMOCBENCH_INLINE void add_squares(const LocalSystem<S>& local, Lanes* hessian, Lanes* of_node) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  const auto column = [&, Z = Z, X = X, n = n](int j) DMOCBENCH_INLINED { return j < Z + n ? j : Z + X; };
  for (int row = 0; row < local.shape.inequalities; ++row) {
    const Lanes weight = Lanes::all(1.0) / local.compliance(row);
    for (int j = 0; j < Z + n + 1; ++j) {
      const Lanes weighed = weight * local.inequality(row, column(j));
      for (int i = 0; i < Z; ++i) hessian[i + column(j) * Z] += weighed * local.inequality(row, i);
      for (int i = 0; i < n && j >= Z; ++i) of_node[i + (j - Z) * n] += weighed * local.inequality(row, Z + i);
    }
  }
}

/// In a lane whose x' is given, the Hessian between x' and other unknowns: no step depends on it, but it could make the
/// pivots of an interval that carries ν negative.
template <class S>
DMOCBENCH_INLINE void drop_terms_of_next(const S& shape, std::size_t lane, Lanes* hessian) {
  const auto [n, Z, X, w, N] = sizes_of(shape);
  for (int j = 0; j < Z + X; ++j) {
    for (int i = 0; i < (j < n ? Z : n); ++i) hessian[i + j * Z].set(lane, 0.0);
  }
}

/// The shape for the elimination of the equalities, a small share of the work: with many unknowns, knowing their number
/// gains little and takes long to compile.
template <class S>
using ForSmallShare = std::conditional_t<(known_nodes<S> <= 4), S, Shape>;

/// The blocks of the intervals `begin` to `begin` + `count` - 1, at most eight, which have no order: what they need of
/// the next interval is in `next_inverse`, whose numbers for the interval before `begin` are left there.
template <class S>
[[gnu::noinline]] void prepare_intervals(const PassSweep<S>& sweep, const NewtonArrays& arrays, int begin, int count,
                                         Pass& pass) {
  using L = ForSmallShare<S>;
  const S shape = sweep.shape;
  const L local_shape = shape_of<L>(sweep.plan);
  const auto [n, Z, X, w, N] = sizes_of(shape);
  gather_neighbours(sweep.plan, arrays, begin, pass.intervals, sweep.locals);
  const LocalSystem<L> local(local_shape, sweep.plan, sweep.locals);
  Memory memory = sweep.local_memory;
  StepWork<L> work(local_shape, memory);
  CostToGo<L> ratio_only(local_shape, memory);
  ratio_only.smallest_ratio = Lanes::all(1e300);
  eliminate_equalities(local, ratio_only, work);
  for (int lane = 0; lane < count; ++lane) {
    const double ratio = ratio_only.smallest_ratio[static_cast<std::size_t>(lane)];
    pass.smallest_ratio = ratio >= pass.smallest_ratio ? pass.smallest_ratio : ratio;
  }
  // (w, x, s, 1) -> -D
  const auto negative_D = [&, n = n](int i, int j)
                              DMOCBENCH_INLINED -> const Lanes& { return work.equalities(i, n + j); };
  const PassRecordBlocks<S> records{shape};
  const int distance = whole_quads(records.size());
  double* const record = sweep.record(pass, begin);
  for (int i = 0; i < n; ++i) {
    put_column(
        n + w, count, [&, n = n, w = w](int j) DMOCBENCH_INLINED { return -negative_D(i, j < n ? w + j : j - n); },
        record + records.increment()(0, i), distance);
    put_column(
        n, count, [&, w = w, n = n](int j) DMOCBENCH_INLINED { return negative_D(j, w + n + i); },
        record + records.inverse()(0, i), distance);
  }
  put_column(
      n, count, [&, N = N](int i) DMOCBENCH_INLINED { return -negative_D(i, N - 1); },
      record + records.constant().first, distance);
  // z' = (inverse of the next interval) (-s'), and -s' = (carry of x) D - (carry of u) u
  for (int i = 0; i < n * n; ++i) {
    Lanes::Vector own;
    Lanes::Vector next;
    const Lanes inverse = negative_D(i % n, w + n + i / n);
    __builtin_memcpy(&own, &inverse, sizeof own);
    __builtin_memcpy(&next, sweep.next_inverse + i, sizeof next);
    own = __builtin_shufflevector(own, next, 1, 2, 3, 4, 5, 6, 7, 8);
    Lanes shifted;
    __builtin_memcpy(&shifted, &own, sizeof own);
    if (count < lane_count) shifted.set(static_cast<std::size_t>(count - 1), sweep.next_inverse[i][0]);
    work.equalities(i % n, w + 2 * n + i / n) = shifted;  // in place of the own one ...
    sweep.next_inverse[i] = inverse;                      // ... which the interval before needs
  }
  const Block next_inverse = block(work.equalities).from(0, w + 2 * n);
  const Block sums{sweep.sums, 1, n};
  set_product<L>(sums, next_inverse, block(local.carry), {n, n, n});
  set_product<L>(sums.from(0, n), next_inverse, block(local.carry).from(0, 2 * n), {n, w, n});
  for (int i = 0; i < n; ++i) {
    put_column(
        n + w, count, [&, n = n](int j) DMOCBENCH_INLINED { return j < n ? sums(i, j) : -sums(i, j); },
        record + records.sums()(0, i), distance);
  }
  // The cost.
  const bool has_squares = shape.inequalities > 0;
  const bool has_last = begin + count == pass.intervals;
  const Lanes* const H = has_squares || has_last ? sweep.hessian : local.hessian.first;
  if (has_squares || has_last) copy(local.hessian.first, Z * (Z + X + 1), sweep.hessian);
  if (has_squares) {
    for (int i = 0; i < n * (n + 1); ++i) sweep.of_node[i] = Lanes{};
    add_squares(local, sweep.hessian, sweep.of_node);
  }
  if (has_last) drop_terms_of_next(shape, static_cast<std::size_t>(count - 1), sweep.hessian);
  const auto of_node = [&, n = n](int i, int j)
                           DMOCBENCH_INLINED { return has_squares ? sweep.of_node[i + j * n] : Lanes{}; };
  const auto hessian = [&, Z = Z](int i, int j) DMOCBENCH_INLINED -> const Lanes& { return H[i + j * Z]; };
  const PassCostBlocks<S> costs{shape};
  for (int j = 0; j < n; ++j) {
    put_column(
        n + w, count, [&, n = n, Z = Z](int i) DMOCBENCH_INLINED { return i < n ? hessian(j, Z + i) : hessian(i, j); },
        sweep.costs + costs.mixed()(0, j), sweep.cost_size);
    put_column(
        n + w, count,
        [&, n = n, Z = Z](int i) DMOCBENCH_INLINED {
          return i < n ? hessian(i, Z + j) + hessian(j, Z + i) + of_node(i, j) : hessian(i, j) + hessian(i, Z + j);
        },
        sweep.costs + costs.form()(0, j), sweep.cost_size);
    put_column(
        n, count, [&](int i) DMOCBENCH_INLINED { return hessian(i, j); }, sweep.costs + costs.next()(0, j),
        sweep.cost_size);
  }
  for (int j = n; j < n + w; ++j) {
    put_column(
        n + w, count,
        [&, n = n, Z = Z](int i)
            DMOCBENCH_INLINED { return i < n ? hessian(j, i) + hessian(j, Z + i) : hessian(i, j); },
        sweep.costs + costs.form()(0, j), sweep.cost_size);
  }
  put_column(
      n + w, count,
      [&, n = n, Z = Z, X = X](int i) DMOCBENCH_INLINED { return i < n ? of_node(i, n) : hessian(i, Z + X); },
      sweep.costs + costs.form()(0, n + w), sweep.cost_size);
  put_column(
      n, count, [&, Z = Z, X = X](int i) DMOCBENCH_INLINED { return hessian(i, Z + X); },
      sweep.costs + costs.next()(0, n), sweep.cost_size);
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
  for (const int entry : plan.unit_entries) sweep.locals[entry] = Lanes::all(1.0);
  for (int i = 0; i < n * n; ++i) sweep.next_inverse[i] = i % n == i / n ? Lanes::all(-1.0) : Lanes{};
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
    pass_backward<S, has_end>(shape, sweep.costs + (interval - pass.prepared) * sweep.cost_size,
                              sweep.record(pass, interval), sweep.end_record(pass, interval), pass.value, sweep.work,
                              signs);
  }
  pass.pivots_hold = signs.hold;
  pass.is_negative = signs.is_negative;
}

template <class S>
void pass_backward_sweep(const EliminationPlan& plan, const NewtonArrays& arrays, int begin, int end, bool carries_nu,
                         Pass& pass) {
  using Carrying = ForSmallShare<S>;  // few intervals carry ν
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
// NOLINTEND(*-reinterpret-cast,*-member-init,*-identifier-naming)
