#include "methods/extensions/interchange/ampl_names.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace dmocbench {

namespace {

/// Names column by column, as `Layout` orders unknowns and rows.
class AmplNames {
 public:
  explicit AmplNames(const Transcription& program)
      : shape_(program.layout().shape()),
        layout_(program.layout()),
        q_(without_spaces(program.problem().configuration_names())),
        u_(without_spaces(program.problem().control_names())) {}

  [[nodiscard]] std::vector<std::string> of_variables() {
    name_states();
    name_controls();
    for (Eigen::Index i = 1; i <= shape_.multipliers; ++i) in_intervals(fmt::format("lambda_{}", i));
    if (shape_.mayer) at_nodes("cost_so_far");
    for (Eigen::Index i = 0; i < shape_.integrals; ++i) at_nodes(fmt::format("integral_{}", i + 1));
    for (const auto& [is_there, end] :
         {std::pair(shape_.first_has_velocity, "first"), std::pair(shape_.last_has_velocity, "last")}) {
      for (const std::string& q : q_) {
        if (is_there) names_.push_back(fmt::format("v_{}_{}", q, end));
      }
    }
    for (Eigen::Index i = 1; i <= shape_.last_multipliers; ++i) names_.push_back(fmt::format("lambda_last_{}", i));
    for (const std::size_t node : shape_.interior_velocities) {
      for (const std::string& q : q_) names_.push_back(fmt::format("v_{}[{}]", q, node));
    }
    for (Eigen::Index i = 0; i < shape_.unknown_parameters; ++i) names_.push_back(fmt::format("parameter_{}", i + 1));
    if (shape_.free_horizon) names_.emplace_back("T");
    return std::move(names_);
  }

  [[nodiscard]] std::vector<std::string> of_rows() {
    for (Eigen::Index i = 0; i < shape_.node_rows; ++i) at_nodes("node_" + q_[static_cast<std::size_t>(i)]);
    for (Eigen::Index i = 0; i < shape_.stage_equations; ++i) in_intervals(fmt::format("equation_{}", i + 1));
    for (Eigen::Index i = 0; i < shape_.path_rows; ++i) in_intervals(fmt::format("path_{}", i + 1));
    if (shape_.mayer) in_intervals("cost_row");
    for (Eigen::Index i = 0; i < shape_.integrals; ++i) in_intervals(fmt::format("integral_row_{}", i + 1));
    const bool has_own_ties = shape_.node_state == NodeState::momentum;
    for (const auto& [is_there, end] :
         {std::pair(shape_.first_has_velocity, "first"), std::pair(shape_.last_has_velocity, "last")}) {
      for (const std::string& q : q_) {
        if (is_there && has_own_ties) names_.push_back(fmt::format("momentum_{}_{}", q, end));
      }
    }
    for (Eigen::Index i = 1; i <= shape_.first_holonomic; ++i) names_.push_back(fmt::format("constraint_first_{}", i));
    for (Eigen::Index i = 1; i <= shape_.last_holonomic; ++i) names_.push_back(fmt::format("constraint_last_{}", i));
    for (const std::size_t node : shape_.interior_velocities) {
      for (const std::string& q : q_) names_.push_back(fmt::format("momentum_{}[{}]", q, node));
    }
    for (Eigen::Index i = 0; i < shape_.conditions; ++i) names_.push_back(fmt::format("condition_{}", i + 1));
    return std::move(names_);
  }

 private:
  static std::vector<std::string> without_spaces(std::vector<std::string> names) {
    for (std::string& name : names) {
      std::ranges::replace_if(
          name, [](unsigned char letter) { return std::isspace(letter) != 0; }, '_');
    }
    return names;
  }

  void at_nodes(const std::string& name) { several(name, shape_.intervals + 1); }
  void in_intervals(const std::string& name) { several(name, shape_.intervals); }
  void several(const std::string& name, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) names_.push_back(fmt::format("{}[{}]", name, k));
  }

  /// q of all nodes, then p or v of all nodes, and the interior rates of the same.
  void name_states() {
    std::vector<std::string> halves{""};
    if (shape_.node_state == NodeState::momentum) halves.emplace_back("p_");
    if (shape_.node_state == NodeState::velocity) halves.emplace_back("v_");
    for (const std::string& half : halves) {
      for (const std::string& q : q_) at_nodes(half + q);
    }
    for (Eigen::Index i = 1; i <= shape_.first_order_size; ++i) at_nodes(fmt::format("y_{}", i));
    for (const std::string& half : halves) {
      for (Eigen::Index stage = 1; stage <= layout_.interior_stages(); ++stage) {
        for (const std::string& q : q_) in_intervals(fmt::format("rate_{}_{}{}", stage, half, q));
      }
    }
    for (Eigen::Index stage = 1; stage <= layout_.interior_first_order_stages(); ++stage) {
      for (Eigen::Index i = 1; i <= shape_.first_order_size; ++i) in_intervals(fmt::format("rate_{}_y_{}", stage, i));
    }
  }

  /// Controls that neighbours share first, then the controls of one interval alone.
  void name_controls() {
    if (shape_.shares_controls) {
      for (const std::string& u : u_) at_nodes(u);
    }
    const Eigen::Index first = shape_.shares_controls ? 2 : 1;
    const Eigen::Index last = shape_.control_stages - (shape_.shares_controls ? 1 : 0);
    for (Eigen::Index stage = first; stage <= last; ++stage) {
      for (const std::string& u : u_) in_intervals(shape_.control_stages > 1 ? fmt::format("{}_{}", u, stage) : u);
    }
  }

  const LayoutShape& shape_;
  const Layout& layout_;
  std::vector<std::string> q_;
  std::vector<std::string> u_;
  std::vector<std::string> names_;
};

}  // namespace

std::vector<std::string> ampl_variable_names(const Transcription& program) { return AmplNames(program).of_variables(); }

std::vector<std::string> ampl_row_names(const Transcription& program) { return AmplNames(program).of_rows(); }

}  // namespace dmocbench
