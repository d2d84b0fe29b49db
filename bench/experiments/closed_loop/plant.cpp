#include "bench/experiments/closed_loop/plant.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "methods/mechanics/forwarding_problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

namespace {

/// The tolerance of the plant's motion, far below the errors of plans.
constexpr double plant_tolerance = 1e-11;

/// The largest excess of an entry over its bounds.
double largest_excess(const Bounds& bounds, const Eigen::VectorXd& values) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < bounds.lower.size(); ++i) {
    const double width = bounds.upper[i] - bounds.lower[i];
    const double excess = std::max(bounds.lower[i] - values[i], values[i] - bounds.upper[i]);
    largest = std::max(largest, std::isfinite(width) && width > 0.0 ? excess / width : excess);
  }
  return largest;
}

}  // namespace

/// The problem with n disturbances after its m controls.
class Plant::Disturbed final : public ForwardingProblem {
 public:
  explicit Disturbed(const Problem& problem) : ForwardingProblem(problem), m_(problem.control_size()) {}
  [[nodiscard]] std::vector<std::string> control_names() const override {
    std::vector<std::string> names = ForwardingProblem::control_names();
    for (const std::string& name : configuration_names()) names.push_back("disturbance_of_" + name);
    return names;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ForwardingProblem::force(undisturbed(x)) + x.u.tail(configuration_size());
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return ForwardingProblem::running_cost(undisturbed(x));
  }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return ForwardingProblem::path_constraints(undisturbed(x));
  }

 private:
  [[nodiscard]] ControlledState undisturbed(const ControlledState& x) const {
    return {.q = x.q, .v = x.v, .u = x.u.head(m_), .t = x.t, .y = x.y};
  }
  Eigen::Index m_;
};

Plant::Plant(const Problem& problem)
    : problem_(problem),
      bounds_(problem.bounds()),
      disturbed_(std::make_unique<Disturbed>(problem)),
      motion_(*disturbed_, plant_tolerance),
      path_constraints_(problem.configuration_size(), problem.control_size(),
                        [&](const ControlledState& x) { return problem.path_constraints(x); }) {
  const TracedProblem traced(problem);
  if (traced.has_symmetry()) {
    momentum_.emplace(problem.configuration_size(), problem.control_size(), [&](const ControlledState& x) {
      const TracedProblem::Values values = traced.at(x);
      return ExpressionVector::Constant(1, values.momentum.dot(values.symmetry));
    });
  }
  begin();
}

Plant::~Plant() = default;

void Plant::begin() {
  motion_.begin_at(problem_.initial_state());
  violation_ = 0.0;
}

void Plant::follow(const Trajectory& plan, double from, double to, const Eigen::VectorXd& disturbance) {
  const double shortest = 1e-12 * (to - from);
  for (Eigen::Index k = 0; k < plan.intervals(); ++k) {  // controls jump at the nodes
    const double left = std::max(plan.node_times[k], from);
    const double right = std::min(plan.node_times[k + 1], to);
    if (right - left <= shortest) continue;
    const auto control = [&](double t) {
      Eigen::VectorXd u(problem_.control_size() + disturbance.size());
      u << control_on_interval(plan, k, t), disturbance;
      return u;
    };
    motion_.carry(control, left, right);
    note_violation(control_on_interval(plan, k, right), right);
  }
}

BoundaryState Plant::state() const { return motion_.state(); }

double Plant::cost(double t) { return motion_.running_cost() + motion_.final_cost(t); }

double Plant::momentum(const BoundaryState& state) {
  Eigen::VectorXd value(1);
  momentum_.value().evaluate(state.q, state.v, Eigen::VectorXd(), 0.0, value);
  return value[0];
}

void Plant::note_violation(const Eigen::VectorXd& u, double t) {
  const BoundaryState x = state();
  Eigen::VectorXd h(path_constraints_.output_count());
  path_constraints_.evaluate(x.q, x.v, u, t, h);
  violation_ = std::max({violation_, largest_excess(bounds_.q, x.q), largest_excess(bounds_.v, x.v),
                         largest_excess(bounds_.u, u), largest_excess(bounds_.of_path(h.size()), h)});
}

}  // namespace dmocbench
