#include "methods/transcription/layout.hpp"

namespace dmocbench {

Layout::Layout(const LayoutShape& shape) : shape_(shape) {
  append_unknowns();
  append_rows();
  place_interval();
  place_ends();
}

std::size_t Layout::append(Places& places, Place::Kind kind, Eigen::Index count, bool are_controls) const {
  const std::size_t head = places.size();
  const std::size_t length = kind == Place::Kind::node ? shape_.intervals + 1 : shape_.intervals;
  for (Eigen::Index i = 0; i < count; ++i) places.append(kind, 0, length, are_controls);
  return head;
}

void Layout::append_singles(Places& places, std::size_t node, Eigen::Index count) {
  for (Eigen::Index i = 0; i < count; ++i) places.append(Place::Kind::node, node, 1);
}

void Layout::append_unknowns() {
  using enum Place::Kind;
  const Eigen::Index m = shape_.control_size;
  Places& unknowns = structure_.unknowns;
  structure_.intervals = shape_.intervals;
  structure_.has_interior_equations = shape_.has_interior_equations;
  append(unknowns, node, node_columns());
  rates_ = append(unknowns, interval, interior_rates());
  append(unknowns, interval, interior_first_order_stages() * shape_.first_order_size, true);
  controls_ = append(unknowns, node, shape_.shares_controls ? m : 0, true);
  inner_controls_ = append(unknowns, interval, (shape_.control_stages - (shape_.shares_controls ? 2 : 0)) * m, true);
  multipliers_ = append(unknowns, interval, shape_.multipliers);
  sums_ = append(unknowns, node, shape_.sums());
  single_unknowns_ = unknowns.size();
  if (shape_.first_has_velocity) append_singles(unknowns, 0, shape_.configuration_size);
  if (shape_.last_has_velocity) append_singles(unknowns, shape_.intervals, shape_.configuration_size);
  append_singles(unknowns, shape_.intervals, shape_.last_multipliers);
  for (const std::size_t number : shape_.interior_velocities)
    append_singles(unknowns, number, shape_.configuration_size);
  const auto globals = static_cast<std::size_t>(shape_.unknown_parameters) + (shape_.free_horizon ? 1 : 0);
  if (globals > 0) unknowns.append(border, 0, globals);
}

void Layout::append_rows() {
  using enum Place::Kind;
  Places& rows = structure_.rows;
  append(rows, node, shape_.node_rows);
  interval_rows_ = append(rows, interval, shape_.interval_rows());
  single_rows_ = rows.size();
  const bool own_ties = shape_.node_state == NodeState::momentum;
  if (shape_.first_has_velocity && own_ties) append_singles(rows, 0, shape_.configuration_size);
  if (shape_.last_has_velocity && own_ties) append_singles(rows, shape_.intervals, shape_.configuration_size);
  append_singles(rows, 0, shape_.first_holonomic);
  append_singles(rows, shape_.intervals, shape_.last_holonomic);
  interior_ties_ = rows.size();
  for (const std::size_t number : shape_.interior_velocities) append_singles(rows, number, shape_.configuration_size);
  if (shape_.conditions > 0) rows.append(border, 0, static_cast<std::size_t>(shape_.conditions));
}

void Layout::place_interval() {
  const Eigen::Index m = shape_.control_size;
  for (const std::size_t right : {0U, 1U}) {
    for (Eigen::Index i = 0; i < node_columns(); ++i) unknown_places_.emplace_back(configuration_head(i) + right);
    for (Eigen::Index i = 0; i < shape_.node_rows; ++i) row_places_.emplace_back(node_row_head(i) + right);
  }
  for (Eigen::Index i = 0; i < interior_columns(); ++i) {
    unknown_places_.emplace_back(rate_head(0, i));
  }
  for (Eigen::Index stage = 0; stage < shape_.control_stages; ++stage) {
    for (Eigen::Index i = 0; i < m; ++i) unknown_places_.emplace_back(control_head(stage, i));
  }
  for (Eigen::Index i = 0; i < shape_.multipliers; ++i) unknown_places_.emplace_back(multiplier_head(i));
  for (const std::size_t right : {0U, 1U}) {
    for (Eigen::Index i = 0; i < shape_.sums(); ++i) unknown_places_.emplace_back(sum_head(i) + right);
  }
  if (shape_.free_horizon) unknown_places_.emplace_back(horizon(), true);
  for (Eigen::Index i = 0; i < shape_.unknown_parameters; ++i) {
    unknown_places_.emplace_back(unknown_parameter(i), true);
  }
  for (Eigen::Index i = 0; i < shape_.interval_rows(); ++i) row_places_.emplace_back(interval_row_head(i));
}

void Layout::place_ends() {
  const Eigen::Index n = shape_.configuration_size;
  const auto place_end = [&](std::size_t node, bool has_velocity, std::size_t velocity) {
    for (Eigen::Index i = 0; i < node_columns(); ++i) {
      end_unknown_places_.emplace_back(configuration_head(i) + node);
    }
    if (!has_velocity) return;
    for (Eigen::Index i = 0; i < n; ++i) end_unknown_places_.emplace_back(velocity + static_cast<std::size_t>(i));
  };
  place_end(0, shape_.first_has_velocity, first_velocity(0));
  place_end(shape_.intervals, shape_.last_has_velocity, last_velocity(0));
  for (Eigen::Index i = 0; i < shape_.last_multipliers; ++i) end_unknown_places_.emplace_back(last_multiplier(i));
  if (shape_.mayer) end_unknown_places_.emplace_back(cost_head() + shape_.intervals);
  if (shape_.free_horizon) end_unknown_places_.emplace_back(horizon());
  for (Eigen::Index i = 0; i < shape_.unknown_parameters; ++i) end_unknown_places_.emplace_back(unknown_parameter(i));

  std::size_t own_row = single_rows_;
  const auto place_tie = [&](std::size_t node) {
    for (Eigen::Index i = 0; i < n; ++i) {
      end_row_places_.emplace_back(shape_.node_state == NodeState::momentum ? own_row++ : node_row_head(i) + node);
    }
  };
  if (shape_.first_has_velocity) place_tie(0);
  if (shape_.last_has_velocity || shape_.last_multipliers > 0) place_tie(shape_.intervals);
  for (Eigen::Index i = 0; i < shape_.first_holonomic + shape_.last_holonomic; ++i) {
    end_row_places_.emplace_back(own_row++);
  }
  const auto conditions = interior_tie(std::ssize(shape_.interior_velocities), 0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(shape_.conditions); ++i) {
    end_row_places_.emplace_back(conditions + i);
  }
}

std::size_t Layout::control_head(Eigen::Index stage, Eigen::Index i) const noexcept {
  const Eigen::Index m = shape_.control_size;
  if (!shape_.shares_controls) return interval_head(inner_controls_, stage * m + i);
  if (stage == 0) return controls_ + static_cast<std::size_t>(i) * (shape_.intervals + 1);
  if (stage == shape_.control_stages - 1) return control_head(0, i) + 1;
  return interval_head(inner_controls_, (stage - 1) * m + i);
}

}  // namespace dmocbench
