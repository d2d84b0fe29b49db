#include "methods/transcription/layout.hpp"

namespace dmocbench {

Layout::Layout(std::size_t intervals, Eigen::Index configuration_size, Eigen::Index control_size, NodeState node_state,
               Eigen::Index stages, bool shares_controls, Eigen::Index node_rows, Eigen::Index private_rows)
    : intervals_(intervals),
      n_(configuration_size),
      m_(control_size),
      node_state_(node_state),
      stages_(stages),
      shares_controls_(shares_controls) {
  const Eigen::Index node_columns = node_state_ == NodeState::configuration ? n_ : 2 * n_;
  const Eigen::Index slope_columns = (stages_ - 1) * node_columns;
  const Eigen::Index shared_columns = shares_controls_ ? m_ : 0;
  const Eigen::Index control_columns = (shares_controls_ ? stages_ - 2 : stages_) * m_;
  structure_.intervals = intervals_;
  for (Eigen::Index i = 0; i < node_columns; ++i) append_column(structure_.unknowns, Place::Kind::node);
  for (Eigen::Index i = 0; i < slope_columns; ++i) append_column(structure_.unknowns, Place::Kind::interval);
  for (Eigen::Index i = 0; i < shared_columns; ++i) append_column(structure_.unknowns, Place::Kind::node);
  for (Eigen::Index i = 0; i < control_columns; ++i) append_column(structure_.unknowns, Place::Kind::interval);
  for (Eigen::Index i = 0; i < node_rows; ++i) append_column(structure_.rows, Place::Kind::node);
  for (Eigen::Index i = 0; i < private_rows; ++i) append_column(structure_.rows, Place::Kind::interval);

  for (const std::size_t right : {0U, 1U}) {
    for (Eigen::Index i = 0; i < node_columns; ++i) unknown_firsts_.push_back(configuration_column(i) + right);
    for (Eigen::Index i = 0; i < node_rows; ++i) row_firsts_.push_back(node_row_column(i) + right);
  }
  for (Eigen::Index i = 0; i < slope_columns; ++i) unknown_firsts_.push_back(slope_q_column(0, i));
  for (Eigen::Index stage = 0; stage < stages_; ++stage) {
    for (Eigen::Index i = 0; i < m_; ++i) unknown_firsts_.push_back(control_column(stage, i));
  }
  for (Eigen::Index i = 0; i < private_rows; ++i) {
    row_firsts_.push_back(node_row_column(node_rows) + static_cast<std::size_t>(i) * intervals_);
  }
}

void Layout::append_column(std::vector<Place>& places, Place::Kind kind) const {
  const std::size_t length = kind == Place::Kind::node ? intervals_ + 1 : intervals_;
  for (std::size_t k = 0; k < length; ++k) places.push_back({kind, k});
}

std::size_t Layout::configuration_column(Eigen::Index i) const noexcept {
  return static_cast<std::size_t>(i) * (intervals_ + 1);
}

std::size_t Layout::second_column(Eigen::Index i) const noexcept { return configuration_column(n_ + i); }

std::size_t Layout::slope_q_column(Eigen::Index stage, Eigen::Index i) const noexcept {
  const Eigen::Index node_columns = node_state_ == NodeState::configuration ? n_ : 2 * n_;
  return configuration_column(node_columns) + static_cast<std::size_t>(stage * n_ + i) * intervals_;
}

std::size_t Layout::slope_y_column(Eigen::Index stage, Eigen::Index i) const noexcept {
  return slope_q_column(stages_ - 1 + stage, i);
}

std::size_t Layout::control_column(Eigen::Index stage, Eigen::Index i) const noexcept {
  const Eigen::Index slopes = (node_state_ == NodeState::configuration ? 1 : 2) * (stages_ - 1);
  const std::size_t head = slope_q_column(slopes, 0);
  if (!shares_controls_) return head + static_cast<std::size_t>(stage * m_ + i) * intervals_;
  if (stage == 0) return head + static_cast<std::size_t>(i) * (intervals_ + 1);
  if (stage == stages_ - 1) return control_column(0, i) + 1;
  return control_column(0, m_) + static_cast<std::size_t>((stage - 1) * m_ + i) * intervals_;
}

std::size_t Layout::node_row_column(Eigen::Index i) const noexcept { return configuration_column(i); }

}  // namespace dmocbench
