// Included by segment_kernel.cpp alone, see lanes.hpp.

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
  apply(record + places.dependent(), places.dependent_rows(), work.dependent);
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
      return is_always_plain<S> ? work.next_state[item.index] : work.dependent[item.index];
    case Emitted::What::multiplier:
      break;
  }
  return work.multipliers[item.index];
}

/// The steps `begin` .. `end` - 1, whose records are there, from the state in `work`.
template <class S>
void substitute_steps(const EliminationPlan& plan, const SegmentGroup& group, int begin, int end, Lanes* outputs,
                      ForwardWork<S>& work, double* primal_step, double* multiplier_step) {
  const S shape = shape_of<S>(plan);
  const int record_size = RecordBlocks<S>{shape}.size();
  const auto* records = reinterpret_cast<const Lanes*>(group.records);
  const auto* nu = reinterpret_cast<const Lanes*>(group.multiplier);
  for (int first = begin; first < end; first += block_steps) {
    const int count = first + block_steps <= end ? block_steps : end - first;
    for (int step = 0; step < count; ++step) {
      step_forward(shape, records + static_cast<std::ptrdiff_t>(first + step - begin) * record_size, nu, work);
      Lanes* output = outputs + step;
      for (const Emitted& item : plan.emitted) {
        *output = emitted_value(item, work);
        output += block_steps;
      }
      for (int i = 0; i < state_size(shape); ++i) work.columns[free_size(shape) + i] = work.next_state[i];
    }
    Lanes* output = outputs;
    for (const Emitted& item : plan.emitted) {
      Lanes block[block_steps];
      for (int step = 0; step < count; ++step) block[step] = output[step];
      write_block(block, group, first, count, (item.is_multiplier ? multiplier_step : primal_step) + item.first);
      output += block_steps;
    }
  }
}

template <class S>
void sweep_forward(const EliminationPlan& plan, const NewtonArrays& arrays, const SegmentGroup& group,
                   double* primal_step, double* multiplier_step) {
  const S shape = shape_of<S>(plan);
  const int X = state_size(shape);
  const int w = free_size(shape);
  const Workspace<S> workspace(shape, group.workspace);
  ForwardWork<S> work(shape, workspace.forward);
  for (int i = 0; i < X; ++i) work.columns[w + i] = reinterpret_cast<const Lanes*>(group.state)[i];
  work.columns[w + X] = Lanes::all(1.0);
  for (int chunk = 0; chunk < chunk_count(group); ++chunk) {
    const int begin = chunk * group.recorded_steps;
    const int end = end_of_chunk(group, chunk);
    // The backward sweep has left the records of the first chunk.
    if (chunk > 0) {
      Rest<S> rest(shape, workspace.rest);
      start_rest(shape, arrays.terminal_weights, rest);
      const Lanes* const checkpoint = checkpoint_of(shape, group, chunk);
      for (int i = 0; i < RestSizes<S>{shape}.value(); ++i) rest.value[i] = checkpoint[i];
      eliminate_steps(plan, arrays, group, begin, end, group.recorded_steps, workspace, rest);
    }
    substitute_steps(plan, group, begin, end, workspace.outputs, work, primal_step, multiplier_step);
  }
}
