#include "methods/transcription/describe_constraint.hpp"

#include <sstream>
#include <vector>

namespace dmocbench {

namespace {

/// A number as a person reads it.
std::string rounded(double value) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

std::string indexed(const std::string& symbol, Eigen::Index i) { return symbol + "[" + std::to_string(i) + "]"; }

/// "q[1] (theta)".
std::string named(const std::string& symbol, Eigen::Index i, const std::vector<std::string>& names) {
  return indexed(symbol, i) + " (" + names[static_cast<std::size_t>(i)] + ")";
}

/// Words for one point of one transcription.
class Wording {
 public:
  Wording(const Problem& problem, const Transcription& transcription, const Eigen::VectorXd& x)
      : problem_(&problem),
        transcription_(&transcription),
        layout_(&transcription.layout()),
        times_(transcription.node_times(x)),
        n_(problem.configuration_size()) {}

  [[nodiscard]] std::string row(std::size_t row) const {
    const LayoutShape& shape = layout_->shape();
    if (row < layout_->node_row_column(shape.node_rows)) {
      const std::size_t nodes = layout_->intervals() + 1;
      return node_row(static_cast<Eigen::Index>(row / nodes), row % nodes);
    }
    const std::size_t head = layout_->private_row_column(0);
    if (row < layout_->private_row_column(shape.interval_rows())) {
      const std::size_t column = (row - head) / layout_->intervals();
      return interval_row(static_cast<Eigen::Index>(column), (row - head) % layout_->intervals());
    }
    return end_row(row);
  }

  [[nodiscard]] std::string unknown(std::size_t unknown) const {
    const LayoutShape& shape = layout_->shape();
    const Place place = layout_->structure().unknowns[unknown];
    if (unknown < layout_->configuration_column(n_)) {
      const auto i = static_cast<Eigen::Index>(unknown / (layout_->intervals() + 1));
      return "bounds().q: " + coordinate(i) + where(place);
    }
    for (Eigen::Index stage = 0; stage < shape.stages; ++stage) {
      for (Eigen::Index i = 0; i < shape.control_size; ++i) {
        const std::size_t column = layout_->control_column(stage, i);
        if (unknown >= column && unknown - column < layout_->intervals()) {
          return "bounds().u: " + named("u", i, problem_->control_names()) + in_interval(unknown - column);
        }
      }
    }
    return std::string("the bounds of ") +
           (place.kind == Place::Kind::border ? "the horizon" : "a velocity, momentum or cost") + where(place);
  }

 private:
  [[nodiscard]] std::string coordinate(Eigen::Index i) const { return named("q", i, problem_->configuration_names()); }

  [[nodiscard]] std::string in_interval(std::size_t k) const {
    const auto left = static_cast<Eigen::Index>(k);
    return " in interval " + std::to_string(k) + " (t = " + rounded(times_[left]) + " to " + rounded(times_[left + 1]) +
           ")";
  }
  [[nodiscard]] std::string where(const Place& place) const {
    if (place.kind == Place::Kind::border) return "";
    if (place.kind == Place::Kind::interval) return in_interval(place.index);
    if (place.index == 0) return in_interval(0);
    if (place.index == layout_->intervals()) return in_interval(place.index - 1);
    return " between intervals " + std::to_string(place.index - 1) + " and " + std::to_string(place.index) +
           " (t = " + rounded(times_[static_cast<Eigen::Index>(place.index)]) + ")";
  }

  /// DMOC's: the momenta of both sides of a node.
  [[nodiscard]] std::string node_row(Eigen::Index i, std::size_t node) const {
    if (node == 0)
      return end_momentum("initial_state", "bounds().first", transcription_->bounds().first, i) + in_interval(0);
    if (node == layout_->intervals()) {
      return end_momentum("final_state", "bounds().last", transcription_->bounds().last, i) + in_interval(node - 1);
    }
    return equation_of(i) + where({Place::Kind::node, node});
  }
  [[nodiscard]] std::string end_momentum(const std::string& state, const std::string& bounds, const EndBounds& end,
                                         Eigen::Index i) const {
    return (end.v.is_fixed(i) ? state : bounds) + ": the momentum (p = L_v of its velocity) of " + coordinate(i);
  }
  [[nodiscard]] std::string equation_of(Eigen::Index i) const {
    return "lagrangian and force: the Euler-Lagrange equation of " + coordinate(i);
  }

  [[nodiscard]] std::string interval_row(Eigen::Index column, std::size_t k) const {
    const LayoutShape& shape = layout_->shape();
    if (column < shape.stage_equations) return private_row(column) + in_interval(k);
    const Eigen::Index path = column - shape.stage_equations;
    if (path >= shape.path_rows) return "running_cost: the cost so far" + in_interval(k);
    const Eigen::Index per_stage = shape.path_rows / shape.stages;
    const std::vector<Eigen::Index> velocities = transcription_->bounds().bounded_velocities();
    const auto bounded = static_cast<Eigen::Index>(velocities.size());
    const Eigen::Index i = path % per_stage;
    if (i >= bounded) return indexed("path_constraints", i - bounded) + in_interval(k);
    return "bounds().v: the velocity of " + coordinate(velocities[static_cast<std::size_t>(i)]) + in_interval(k);
  }
  /// The element's own. An element of another kind than these three families has rows of which only the number is
  /// known.
  [[nodiscard]] std::string private_row(Eigen::Index column) const {
    const LayoutShape& shape = layout_->shape();
    const bool is_second = (column / n_) % 2 == 1;
    switch (shape.node_state) {
      case NodeState::configuration:
        if (shape.stage_equations != (shape.stages - 1) * n_) break;
        return equation_of(column % n_);
      case NodeState::momentum:
        if (shape.stage_equations != 2 * shape.stages * n_) break;
        return is_second ? equation_of(column % n_) : "lagrangian: the momentum p = L_v of " + coordinate(column % n_);
      case NodeState::velocity:
        if (shape.stage_equations != 2 * shape.stages * n_) break;
        return is_second ? equation_of(column % n_) : "the velocity as slope of " + coordinate(column % n_);
    }
    return "row " + std::to_string(column) + " of the method";
  }

  [[nodiscard]] std::string end_row(std::size_t row) const {
    const std::size_t first_condition = layout_->row_count() - static_cast<std::size_t>(layout_->shape().conditions);
    if (row >= first_condition) {
      return indexed("boundary_conditions", static_cast<Eigen::Index>(row - first_condition));
    }
    const Place place = layout_->structure().rows[row];
    const std::size_t head = layout_->private_row_column(layout_->shape().interval_rows());
    const auto i = static_cast<Eigen::Index>(row - head) % n_;
    return "lagrangian: the momentum p = L_v of " + coordinate(i) + where(place);
  }

  const Problem* problem_;
  const Transcription* transcription_;
  const Layout* layout_;
  Eigen::VectorXd times_;
  Eigen::Index n_;
};

}  // namespace

std::string describe_constraint(const Problem& problem, const Transcription& transcription, const Eigen::VectorXd& x,
                                std::size_t row) {
  return Wording(problem, transcription, x).row(row);
}

std::string unknown_in_words(const Problem& problem, const Transcription& transcription, const Eigen::VectorXd& x,
                             std::size_t unknown) {
  return Wording(problem, transcription, x).unknown(unknown);
}

}  // namespace dmocbench
