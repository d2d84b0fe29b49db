// Included by segment_kernel.cpp alone, see lanes.hpp.

template <class S>
S shape_of(const EliminationPlan& plan) {
  if constexpr (std::is_same_v<S, Shape>) {
    return plan.shape;
  } else {
    return S{plan.shape.inequalities};
  }
}

/// The value at the end of a segment: ½ Σ ρ_i X_i² + νᵀX.
template <class S>
inline void start_rest(const S& shape, const double* terminal_weights, Rest<S>& rest) {
  const int X = state_size(shape);
  for (int i = 0; i < X * (2 * X + 1); ++i) rest.value[i] = Lanes{};
  for (int i = 0; i < X * (X + 1); ++i) rest.reach[i] = Lanes{};
  for (int i = 0; i < X; ++i) {
    rest.value[i + i * X] = Lanes::all(terminal_weights[i]);
    rest.value[i + (X + 1 + i) * X] = Lanes::all(1.0);
  }
  *rest.pivots_hold = Lanes::all(1.0);
  *rest.smallest_ratio = Lanes::all(1e300);
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
  const Lanes held_before = *work.rest.pivots_hold;
  const Lanes ratio_before = *work.rest.smallest_ratio;
  eliminate_equalities(shape, local, plan.node_in_next.data(), plan.pivot_scales.data(), work);
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
    *work.rest.pivots_hold = chosen(*active, *work.rest.pivots_hold, held_before);
    *work.rest.smallest_ratio = chosen(*active, *work.rest.smallest_ratio, ratio_before);
  }
  if (!has_own_rows(shape)) store_multipliers(shape, work, record + places.multipliers());
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

/// Memory of both sweeps over a group, one part behind the other.
template <class S>
struct Workspace {
  Workspace(const S& shape, double* numbers)
      : rest(reinterpret_cast<Lanes*>(numbers)),
        step(rest + RestSizes<S>{shape}.all()),
        locals(step + StepSizes<S>{shape}.all()),
        forward(locals + block_steps * LocalBlocks<S>{shape}.size()),
        outputs(forward + ForwardWork<S>::size(shape)) {}

  static int size(const EliminationPlan& plan, const S& shape) {
    return RestSizes<S>{shape}.all() + StepSizes<S>{shape}.all() + block_steps * LocalBlocks<S>{shape}.size() +
           ForwardWork<S>::size(shape) + block_steps * static_cast<int>(plan.emitted.size());
  }

  Lanes* rest;
  Lanes* step;
  Lanes* locals;  // blocks of the steps that are collected together
  Lanes* forward;
  Lanes* outputs;  // per emitted number, the steps of a block
};

/// Eliminates the steps `begin` .. `end` - 1 of all segments, last to first, in front of `rest`. A pivot that fails
/// ends it: nobody reads what would follow. `ahead` as in `collect`. Not inlined: both sweeps use it, and it is long.
template <class S>
[[gnu::noinline]] void eliminate_steps(const EliminationPlan& plan, const NewtonArrays& arrays,
                                       const SegmentGroup& group, int begin, int end, int ahead,
                                       const Workspace<S>& workspace, Rest<S>& rest) {
  const S shape = shape_of<S>(plan);
  const int local_size = LocalBlocks<S>{shape}.size();
  const int record_size = RecordBlocks<S>{shape}.size();
  auto* const records = reinterpret_cast<Lanes*>(group.records);
  StepWork<S> work(shape, workspace.step, rest);
  const int blocks = (end - begin + block_steps - 1) / block_steps;
  for (int block = blocks - 1; block >= 0 && smallest_of(*work.rest.pivots_hold) > 0.0; --block) {
    const int first = begin + block * block_steps;
    const int count = first + block_steps <= end ? block_steps : end - first;
    collect(plan, arrays, group, first, count, ahead, workspace.locals, local_size);
    for (int step = first + count - 1; step >= first; --step) {
      const bool is_last = step == group.steps - 1;
      const Lanes::Mask active = active_at(group, step);
      step_backward(shape, plan, workspace.locals + (step - first) * local_size, is_last ? &active : nullptr, work,
                    records + static_cast<std::ptrdiff_t>(step - begin) * record_size);
    }
  }
  rest = work.rest;
}

/// How many chunks of steps a group's records are made in.
inline int chunk_count(const SegmentGroup& group) {
  return (group.steps + group.recorded_steps - 1) / group.recorded_steps;
}
inline int end_of_chunk(const SegmentGroup& group, int chunk) {
  const int end = (chunk + 1) * group.recorded_steps;
  return end < group.steps ? end : group.steps;
}
template <class S>
Lanes* checkpoint_of(const S& shape, const SegmentGroup& group, int chunk) {
  return reinterpret_cast<Lanes*>(group.checkpoints) + static_cast<std::ptrdiff_t>(chunk) * RestSizes<S>{shape}.value();
}

template <class S>
void sweep_backward(const EliminationPlan& plan, const NewtonArrays& arrays, SegmentGroup& group) {
  const S shape = shape_of<S>(plan);
  const Workspace<S> workspace(shape, group.workspace);
  Rest<S> rest(shape, workspace.rest);
  prepare_locals(plan, LocalBlocks<S>{shape}.size(), workspace.locals);
  start_rest(shape, arrays.terminal_weights, rest);
  const int chunks = chunk_count(group);
  for (int chunk = chunks - 1; chunk >= 0; --chunk) {
    if (chunks > 1) {
      Lanes* const checkpoint = checkpoint_of(shape, group, chunk);
      for (int i = 0; i < RestSizes<S>{shape}.value(); ++i) checkpoint[i] = rest.value[i];
    }
    eliminate_steps(plan, arrays, group, chunk * group.recorded_steps, end_of_chunk(group, chunk),
                    chunks > 1 ? -block_steps : 0, workspace, rest);
  }
  group.pivots_hold = smallest_of(*rest.pivots_hold) > 0.0;
  group.smallest_ratio = smallest_of(*rest.smallest_ratio);
  if (!group.pivots_hold) return;
  const int X = state_size(shape);
  auto* value = reinterpret_cast<Lanes*>(group.value);
  auto* reach = reinterpret_cast<Lanes*>(group.reach);
  for (int i = 0; i < X * (2 * X + 1); ++i) value[i] = rest.value[i];
  for (int i = 0; i < X * (X + 1); ++i) reach[i] = rest.reach[i];
  for (int j = 0; j < X; ++j) {
    for (int i = 0; i < j; ++i) reach[i + (1 + j) * X] = rest.reach[j + (1 + i) * X];
  }
}
