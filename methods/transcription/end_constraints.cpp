#include "methods/transcription/end_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/expression/schedule.hpp"
#include "methods/mechanics/holonomic_constraints.hpp"
#include "methods/mechanics/member_name.hpp"

namespace dmocbench {

namespace {

/// The known part of the point (q, v, u, t) at an end: the values, 0 where they are unknown.
struct KnownPoint {
  const char* name;             ///< of the function that states it
  double time;                  ///< of the end
  std::vector<double> values;   ///< q, v, u, y, t
  std::vector<bool> are_given;  ///< as many
};

KnownPoint known_point(const char* name, const EndBounds& end, Eigen::Index controls, double time, bool is_time_given) {
  const auto add = [](KnownPoint& point, const Bounds& bounds) {
    for (Eigen::Index i = 0; i < bounds.lower.size(); ++i) {
      point.values.push_back(bounds.is_fixed(i) ? bounds.lower[i] : 0.0);
      point.are_given.push_back(bounds.is_fixed(i));
    }
  };
  KnownPoint point{name, time, {}, {}};
  add(point, end.q);
  add(point, end.v);
  point.values.resize(point.values.size() + static_cast<std::size_t>(controls), 0.0);
  point.are_given.resize(point.values.size(), false);
  add(point, end.y);
  point.values.push_back(time);
  point.are_given.push_back(is_time_given);
  return point;
}

/// True unless every constraint is kept where the components that are not given vanish, which settles most problems
/// fast.
bool may_be_broken(const TracedProblem& traced, const Bounds& path, const KnownPoint& point) {
  const Eigen::Index n = traced.configuration_size();
  const Eigen::Map<const Eigen::VectorXd> x(point.values.data(), static_cast<Eigen::Index>(point.values.size()));
  const Eigen::Index m = traced.control_size();
  const MotionPoint numbers{x.head(n), x.segment(n, n), x.segment(2 * n, m),
                            x.segment(2 * n + m, traced.first_order_size())};
  const Eigen::MatrixXd table = traced.table({&numbers, 1}, Eigen::VectorXd::Constant(1, point.time));
  const auto h = table.row(0).segment(3 * n + 1, traced.path_constraint_count());
  return !((h.transpose().array() >= path.lower.array()).all() && (h.transpose().array() <= path.upper.array()).all());
}

bool reads_given_only(const Schedule& formula, const std::vector<bool>& are_given) {
  return std::ranges::all_of(formula.steps(), [&](const Schedule::Step& step) {
    return step.operation != Operation::input || are_given[step.input_index];
  });
}

/// The uncertainty of a formula of numbers known to twelve digits: Σ |∂h/∂x_i x_i| 1e-12.
double uncertainty(const Expression& h, const ExpressionVector& inputs, std::span<const double> values) {
  const std::vector<double> derivatives = replay<double>(Schedule(gradient(h, inputs)), values);
  double sum = 1.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += std::abs(derivatives[i] * values[i]);
  return 1e-12 * sum;
}

void require_constraints_at(const KnownPoint& point, const Problem& problem, const TracedProblem& traced,
                            const Bounds& path) {
  if (!may_be_broken(traced, path, point)) return;
  const Eigen::Index n = traced.configuration_size();
  const Eigen::Index m = traced.control_size();
  const Eigen::Index l = traced.first_order_size();
  const ExpressionVector x = input_vector(0, 2 * n + m + l + 1);
  const ExpressionVector constraints = traced
                                           .at(ControlledState{x.head(n), x.segment(n, n), x.segment(2 * n, m),
                                                               x[2 * n + m + l], x.segment(2 * n + m, l)})
                                           .path_constraints;
  const std::vector<std::string> names = problem.card().path_constraint_names;
  const std::span<const double> values(point.values);
  for (std::size_t i = 0; i < static_cast<std::size_t>(constraints.size()); ++i) {
    const Expression& h = constraints[static_cast<Eigen::Index>(i)];
    const Schedule formula(std::span(&h, 1));
    if (!reads_given_only(formula, point.are_given)) continue;
    const double value = replay<double>(formula, values).front();
    const auto entry = static_cast<Eigen::Index>(i);
    const bool is_below = value < path.lower[entry];
    const double excess = is_below ? path.lower[entry] - value : value - path.upper[entry];
    if (!(excess > uncertainty(h, x, values))) continue;  // a NaN at an end may be a number inside
    throw Error(
        fmt::format("{}: {} and path_constraints contradict each other: path_constraints[{}]{} is {:g} there (t = "
                    "{:g}), and has to be at {} {:g}",
                    problem.name(), member_name(point.name), i, names.empty() ? "" : " (" + names[i] + ")", value,
                    point.time, is_below ? "least" : "most", is_below ? path.lower[entry] : path.upper[entry]));
  }
}

}  // namespace

void require_path_constraints_at_ends(const Problem& problem, const TracedProblem& traced, const ProblemBounds& bounds,
                                      double horizon) {
  // Unknown parameters may be such that the ends keep the constraints.
  if (traced.path_constraint_count() == 0 || traced.unknown_count() > 0) return;
  const Bounds path = bounds.of_path(traced.path_constraint_count());
  const Eigen::Index m = traced.control_size();
  require_constraints_at(known_point("initial_state", bounds.first, m, 0.0, true), problem, traced, path);
  require_constraints_at(known_point("final_state", bounds.last, m, horizon, !bounds.horizon.is_free()), problem,
                         traced, path);
}

void require_holonomic_constraints_at_ends(const Problem& problem, const TracedProblem& traced,
                                           const ProblemBounds& bounds) {
  // Unknown parameters may be such that the ends keep the constraints.
  if (traced.holonomic_count() == 0 || traced.unknown_count() > 0) return;
  constexpr double known_digits = 1e-9;  // ends are numbers that users compute
  HolonomicConstraints constraints(traced);
  const auto require_small = [&](const Eigen::VectorXd& values, const Eigen::VectorXd& of, const char* what,
                                 const char* name) {
    const Eigen::VectorXd terms = constraints.jacobian().cwiseAbs() * of.cwiseAbs();
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      if (std::abs(values[i]) <= known_digits * (1.0 + terms[i])) continue;
      throw Error(fmt::format("{}: {} does not keep constraints[{}]: {} = {:.3g} there, and has to be 0",
                              problem.name(), member_name(name), i, what, values[i]));
    }
  };
  for (const auto& [end, name] : {std::pair(&bounds.first, "initial_state"), std::pair(&bounds.last, "final_state")}) {
    if (!end->q.all_fixed()) continue;
    constraints.evaluate(end->q.lower);
    require_small(constraints.residual(), end->q.lower, "g", name);
    if (!end->v.all_fixed()) continue;
    require_small(constraints.jacobian() * end->v.lower, end->v.lower, "G v", name);
  }
}

}  // namespace dmocbench
