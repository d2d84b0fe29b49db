#include "methods/extensions/primitives/primitive_library.hpp"

#include <algorithm>
#include <cmath>

#include "methods/error.hpp"
#include "methods/mechanics/point_function.hpp"

namespace dmocbench {

namespace {

std::vector<std::pair<std::string, double>> parameters_with_values(const Problem& problem) {
  std::vector<std::pair<std::string, double>> parameters;
  for (const Parameter& each : problem.parameters()) parameters.emplace_back(each.name, problem.parameter(each.name));
  return parameters;
}

bool has_size(const Eigen::MatrixXd& table, Eigen::Index rows, Eigen::Index columns) {
  return table.rows() == rows && table.cols() == columns && table.allFinite();
}

/// Whether all numbers and sizes of a primitive agree with its library.
bool fits(const Primitive& primitive, const PrimitiveLibrary& library, Eigen::Index n, Eigen::Index m) {
  const Eigen::Index intervals = Eigen::Index{primitive.duration} * library.intervals_per_step;
  return primitive.first < library.states.size() && primitive.last < library.states.size() && primitive.duration >= 1 &&
         std::isfinite(primitive.cost) && has_size(primitive.displacement.linear, n, n) &&
         has_size(primitive.displacement.shift, n, 1) && has_size(primitive.q, intervals + 1, n) &&
         has_size(primitive.v, intervals + 1, n) && has_size(primitive.u, intervals, m);
}

/// Throws `Error` unless every primitive has the cost of its motion, by the midpoint rule with the library's step.
void require_true_costs(const PrimitiveLibrary& library, const Problem& problem) {
  constexpr double digits = 1e-6;
  constexpr double share_of_largest = 1e-9;  // a primitive that costs nothing may cost rounding
  PointFunction cost(problem.configuration_size(), problem.control_size(),
                     [&](const ControlledState& x) { return ExpressionVector{{problem.running_cost(x)}}; });
  const double h = library.step / library.intervals_per_step;
  double largest = 0.0;
  for (const Primitive& each : library.primitives) largest = std::max(largest, std::abs(each.cost));
  for (const Primitive& each : library.primitives) {
    double sum = 0.0;
    double size = 0.0;
    for (Eigen::Index k = 0; k < each.u.rows(); ++k) {
      Eigen::VectorXd value(1);
      cost.evaluate(0.5 * (each.q.row(k) + each.q.row(k + 1)).transpose(),
                    (each.q.row(k + 1) - each.q.row(k)).transpose() / h, each.u.row(k).transpose(), 0.0, value);
      sum += h * value[0];
      size += h * std::abs(value[0]);
    }
    if (std::abs(each.cost - sum) <= digits * size + share_of_largest * largest) continue;
    throw Error(
        "the primitives of {} are damaged: the stated cost of a primitive is {:g}, but the cost of its "
        "trajectory is {:g}",
        problem.name(), each.cost, sum);
  }
}

}  // namespace

PrimitiveLibrary PrimitiveLibrary::of(const Problem& problem, double step, int intervals_per_step) {
  return {.problem = problem.name(),
          .parameters = parameters_with_values(problem),
          .step = step,
          .intervals_per_step = intervals_per_step};
}

void PrimitiveLibrary::require_made_for(const Problem& asked) const {
  if (problem != asked.name()) {
    throw Error("the primitives belong to {}, not to {}", problem, asked.name());
  }
  const auto expected = parameters_with_values(asked);
  if (parameters.size() != expected.size()) {
    throw Error("the primitives of {} were computed with other parameters; compute them again", problem);
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (parameters[i] == expected[i]) continue;
    throw Error("the primitives of {} were computed with {} = {:g}, not {} = {:g}; compute them again", problem,
                parameters[i].first, parameters[i].second, expected[i].first, expected[i].second);
  }
  const Eigen::Index n = asked.configuration_size();
  constexpr double most_steps = 1e6;  // of a horizon
  bool all_fit = asked.horizon() / most_steps <= step && std::isfinite(step) && intervals_per_step >= 1;
  for (const BoundaryState& state : states) all_fit = all_fit && has_size(state.q, n, 1) && has_size(state.v, n, 1);
  for (const Primitive& each : primitives) all_fit = all_fit && fits(each, *this, n, asked.control_size());
  if (!all_fit) throw Error("the primitives of {} are damaged: their sizes do not match; compute them again", problem);
  require_true_costs(*this, asked);
}

}  // namespace dmocbench
