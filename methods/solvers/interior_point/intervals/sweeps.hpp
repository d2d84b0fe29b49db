// Included by segment_kernel.cpp alone, see lanes.hpp.

template <class S>
S shape_of(const EliminationPlan& plan) {
  if constexpr (std::is_same_v<S, Shape>) {
    return plan.shape;
  } else {
    return S{plan.shape.soft};
  }
}

/// The value at the end of a segment: ½ Σ ρ_i X_i² + νᵀX.
template <class S>
inline void start_value(const S& shape, const double* terminal_weights, StepWork<S>& work) {
  const int X = state_size(shape);
  for (int i = 0; i < X * (2 * X + 1); ++i) work.value[i] = Lanes{};
  for (int i = 0; i < X * (X + 1); ++i) work.reach[i] = Lanes{};
  for (int i = 0; i < X; ++i) {
    work.value[i + i * X] = Lanes::all(terminal_weights[i]);
    work.value[i + (X + 1 + i) * X] = Lanes::all(1.0);
  }
  *work.pivots_hold = Lanes::all(1.0);
  *work.smallest_ratio = Lanes::all(1e300);
}

/// Entries for which nothing is collected keep what this gives them.
inline void prepare_locals(const EliminationPlan& plan, int local_size, Lanes* locals) {
  for (int i = 0; i < block_steps * local_size; ++i) locals[i] = Lanes{};
  for (int step = 0; step < block_steps; ++step) {
    for (const int entry : plan.ones) locals[step * local_size + entry] = Lanes::all(1.0);
  }
}

/// Which lanes have an interval at a step.
inline Lanes::Mask active_at(const SegmentGroup& group, int step) {
  Lanes::Mask mask{};
  for (int lane = 0; lane < lane_count; ++lane) mask[lane] = step < group.length[lane] ? -1 : 0;
  return mask;
}

inline double smallest_of(const Lanes& lanes) {
  double smallest = lanes.v[0];
  // A comparison that is false for NaN, so that NaN is found.
  for (int lane = 1; lane < lane_count; ++lane) smallest = lanes.v[lane] >= smallest ? smallest : lanes.v[lane];
  return smallest;
}

template <class S>
DMOCBENCH_INLINE void step_backward(const S& shape, const EliminationPlan& plan, const Lanes* local,
                                    const Lanes::Mask* active, StepWork<S>& work, Lanes* record) {
  const LocalBlocks<S> blocks{shape};
  const RecordBlocks<S> places{shape};
  const Lanes held_before = *work.pivots_hold;
  const Lanes ratio_before = *work.smallest_ratio;
  eliminate_equalities(shape, local, plan.pivot_scales.data(), work);
  make_transition(shape, blocks, local, plan.node_in_next.data(), work);
  condense(shape, blocks, local, work);
  factorise_free(shape, work);
  store_gain(shape, work, record + places.gain());
  store_transition(shape, work, record + places.transition(), record + places.dependent());
  if (has_own_rows(shape)) {
    store_slope(shape, blocks, local, plan.node_in_next.data(), work, record + places.slope());
    store_factors(shape, work, record + places.factors());
  }
  if (active == nullptr) {
    advance(shape, true, Lanes::Mask{}, work);
  } else {
    advance(shape, false, *active, work);
    *work.pivots_hold = chosen(*active, *work.pivots_hold, held_before);
    *work.smallest_ratio = chosen(*active, *work.smallest_ratio, ratio_before);
  }
  if (!has_own_rows(shape)) store_multipliers(shape, work, record + places.multipliers());
}

template <class S>
void sweep_backward(const EliminationPlan& plan, const NewtonArrays& arrays, SegmentGroup& group) {
  const S shape = shape_of<S>(plan);
  const LocalBlocks<S> blocks{shape};
  const RecordBlocks<S> places{shape};
  auto* memory = reinterpret_cast<Lanes*>(group.workspace);
  Lanes* const locals = memory + StepSizes<S>{shape}.all();
  StepWork<S> work(shape, memory);
  prepare_locals(plan, blocks.size(), locals);
  start_value(shape, arrays.terminal_weights, work);
  const int blocks_there = (group.steps + block_steps - 1) / block_steps;
  // A pivot that fails ends the sweep: nobody reads what would follow.
  for (int block = blocks_there - 1; block >= 0 && smallest_of(*work.pivots_hold) > 0.0; --block) {
    const int begin = block * block_steps;
    const int count = begin + block_steps <= group.steps ? block_steps : group.steps - begin;
    collect(plan, arrays, group, begin, count, locals, blocks.size());
    for (int step = begin + count - 1; step >= begin; --step) {
      const bool is_last = step == group.steps - 1;
      const Lanes::Mask active = active_at(group, step);
      step_backward(shape, plan, locals + (step - begin) * blocks.size(), is_last ? &active : nullptr, work,
                    reinterpret_cast<Lanes*>(group.records) + static_cast<std::ptrdiff_t>(step) * places.size());
    }
  }
  group.pivots_hold = smallest_of(*work.pivots_hold) > 0.0;
  group.smallest_ratio = smallest_of(*work.smallest_ratio);
  if (!group.pivots_hold) return;
  const int X = state_size(shape);
  auto* value = reinterpret_cast<Lanes*>(group.value);
  auto* reach = reinterpret_cast<Lanes*>(group.reach);
  for (int i = 0; i < X * (2 * X + 1); ++i) value[i] = work.value[i];
  for (int i = 0; i < X * (X + 1); ++i) reach[i] = work.reach[i];
  for (int j = 0; j < X; ++j) {
    for (int i = 0; i < j; ++i) reach[i + (1 + j) * X] = work.reach[j + (1 + i) * X];
  }
}

/// One step forward: the next state, and what the step of this interval is made of.
template <class S>
struct ForwardWork {
  ForwardWork(const S& shape, Lanes* memory)
      : columns(memory),
        next_state(columns + column_count(shape)),
        dependent(next_state + state_size(shape)),
        multipliers(dependent + shape.rows) {}

  static int size(const S& shape) { return column_count(shape) + state_size(shape) + 2 * shape.rows + shape.carried; }

  Lanes* columns;  // (w, X, 1)
  Lanes* next_state;
  Lanes* dependent;
  Lanes* multipliers;
};

template <class S>
inline void step_forward(const S& shape, const Lanes* record, const Lanes* nu, ForwardWork<S>& work) {
  const RecordBlocks<S> places{shape};
  const int w = free_size(shape);
  const int X = state_size(shape);
  const int N = column_count(shape);
  const int n = shape.rows;
  const int kept = shape.node + shape.carried;
  const Lanes* const gain = record + places.gain();
  for (int i = 0; i < w; ++i) {
    Lanes sum{};
    for (int j = 0; j <= X; ++j) sum -= gain[i + j * w] * work.columns[w + j];
    for (int j = 0; j < X; ++j) sum -= gain[i + (X + 1 + j) * w] * nu[j];
    work.columns[i] = sum;
  }
  const auto apply = [&](const Lanes* matrix, int rows, Lanes* result) {
    for (int i = 0; i < rows; ++i) {
      Lanes sum{};
      for (int j = 0; j < N; ++j) sum += matrix[i + j * rows] * work.columns[j];
      result[i] = sum;
    }
  };
  apply(record + places.transition(), kept, work.next_state);
  for (int i = kept; i < X; ++i) work.next_state[i] = work.columns[w + i];
  apply(record + places.dependent(), n, work.dependent);
  if (has_own_rows(shape)) {
    const Lanes* const slope = record + places.slope();
    apply(slope, n, work.multipliers);
    for (int i = 0; i < n; ++i) {
      Lanes sum = work.multipliers[i];
      for (int j = 0; j < X; ++j) sum += slope[i + (N + j) * n] * nu[j];
      work.multipliers[i] = -sum;
    }
    solve_transposed(shape, record + places.factors(), work.multipliers);
  } else {
    const Lanes* const rows = record + places.multipliers();
    for (int i = 0; i < shape.carried; ++i) {
      Lanes sum{};
      for (int j = 0; j <= X; ++j) sum += rows[i + j * shape.carried] * work.columns[w + j];
      for (int j = 0; j < X; ++j) sum += rows[i + (X + 1 + j) * shape.carried] * nu[j];
      work.multipliers[i] = sum;
    }
  }
}

template <class S>
inline const Lanes& emitted_value(const Emitted& item, const ForwardWork<S>& work) {
  switch (item.what) {
    case Emitted::What::state:
      return work.next_state[item.index];
    case Emitted::What::free:
      return work.columns[item.index];
    case Emitted::What::dependent:
      return work.dependent[item.index];
    case Emitted::What::multiplier:
      break;
  }
  return work.multipliers[item.index];
}

template <class S>
void sweep_forward(const EliminationPlan& plan, const SegmentGroup& group, double* primal_step,
                   double* multiplier_step) {
  const S shape = shape_of<S>(plan);
  const int X = state_size(shape);
  const int w = free_size(shape);
  auto* memory = reinterpret_cast<Lanes*>(group.workspace);
  Lanes* const outputs = memory + ForwardWork<S>::size(shape);  // per emitted number, the steps of a block
  ForwardWork<S> work(shape, memory);
  const auto* records = reinterpret_cast<const Lanes*>(group.records);
  const auto* nu = reinterpret_cast<const Lanes*>(group.multiplier);
  for (int i = 0; i < X; ++i) work.columns[w + i] = reinterpret_cast<const Lanes*>(group.state)[i];
  work.columns[w + X] = Lanes::all(1.0);
  for (int begin = 0; begin < group.steps; begin += block_steps) {
    const int count = begin + block_steps <= group.steps ? block_steps : group.steps - begin;
    for (int step = 0; step < count; ++step) {
      step_forward(shape, records + static_cast<std::ptrdiff_t>(begin + step) * RecordBlocks<S>{shape}.size(), nu,
                   work);
      Lanes* output = outputs + step;
      for (const Emitted& item : plan.emitted) {
        *output = emitted_value(item, work);
        output += block_steps;
      }
      for (int i = 0; i < X; ++i) work.columns[w + i] = work.next_state[i];
    }
    Lanes* output = outputs;
    for (const Emitted& item : plan.emitted) {
      Lanes block[8];
      for (int step = 0; step < count; ++step) block[step] = output[step];
      write_block(block, group, begin, count, (item.is_multiplier ? multiplier_step : primal_step) + item.first);
      output += block_steps;
    }
  }
}

/// Of both sweeps, which use the same memory one after the other.
template <class S>
std::size_t numbers_of_workspace(const EliminationPlan& plan) {
  const S shape = shape_of<S>(plan);
  const int backward = StepSizes<S>{shape}.all() + block_steps * LocalBlocks<S>{shape}.size();
  const int forward = ForwardWork<S>::size(shape) + block_steps * static_cast<int>(plan.emitted.size());
  return static_cast<std::size_t>(lane_count) * static_cast<std::size_t>(backward > forward ? backward : forward);
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

inline SegmentKernel choose_kernel(const Shape& shape) {
  // n = m = 1 and 2, DMOC and collocation, with a fixed horizon: midpoint.
  return choose<FixedShape<2, 2, 0, 1, 2>, FixedShape<4, 0, 0, 1, 4>,  //
                FixedShape<2, 2, 0, 2, 2>, FixedShape<4, 0, 0, 2, 4>,  //
                FixedShape<1, 1, 0, 1, 1>, FixedShape<2, 0, 0, 1, 2>>(shape);
}
