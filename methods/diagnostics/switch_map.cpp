#include "methods/diagnostics/switch_map.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include <Eigen/QR>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"

namespace dmocbench {

namespace {

Eigen::VectorXd in_one_vector(const BoundaryState& state) {
  Eigen::VectorXd all(state.q.size() + state.v.size() + state.y.size());
  all << state.q, state.v, state.y;
  return all;
}

}  // namespace

SwitchMap::SwitchMap(const PhasedProblem& problem, std::size_t i, const Eigen::VectorXd& unknowns)
    : unknowns_(unknowns) {
  const ParameterTrace trace(problem, {});
  InputCounter inputs;
  const ExpressionVector open = inputs.take(unknowns.size());
  const auto state = [&](std::size_t phase) {
    const PhasedProblem::Part& part = problem.parts()[phase];
    State x{inputs.take(part.q.size), inputs.take(part.q.size), {}};
    x.y = inputs.take(part.y.size);
    return x;
  };
  State before = state(problem.preceding(i + 1));
  before.t = inputs.take();
  State after = state(i + 1);
  after.t = 0.0;
  const ExpressionVector all = problem.link_of(i, before, after);
  // Conditions on the state before alone, the guard, choose the time of the switch, which is given here.
  ExpressionVector solved_for = stacked({after.q, after.v, after.y});
  const auto rows_that_read = [&](const ExpressionVector& variables) {
    std::vector<Expression> rows;
    const ExpressionMatrix derivative = jacobian(all, variables);
    for (Eigen::Index row = 0; row < all.size(); ++row) {
      const auto entries = derivative.row(row);
      if (!std::all_of(entries.begin(), entries.end(), [](const Expression& e) { return e.is_zero(); }))
        rows.push_back(all[row]);
    }
    return rows;
  };
  if (std::ssize(rows_that_read(solved_for)) > solved_for.size()) solved_for = stacked({solved_for, open});
  const std::vector<Expression> rows = rows_that_read(solved_for);
  const ExpressionVector conditions = Eigen::Map<const ExpressionVector>(rows.data(), std::ssize(rows));
  rows_ = conditions.size();
  solved_ = solved_for.size();
  conditions_ = Schedule(stacked({conditions, ExpressionVector(jacobian(conditions, solved_for).reshaped())}));
}

BoundaryState SwitchMap::after(const BoundaryState& before, double time, const BoundaryState& start) const {
  constexpr int most_steps = 50;
  Eigen::VectorXd x = in_one_vector(start);
  const Eigen::Index state_size = x.size();
  if (solved_ > state_size) {
    x.conservativeResize(solved_);
    x.tail(unknowns_.size()) = unknowns_;
  }
  for (int step = 0; step < most_steps; ++step) {
    Eigen::VectorXd inputs(unknowns_.size() + 2 * before.q.size() + before.y.size() + 1 + state_size);
    inputs << (solved_ > state_size ? Eigen::VectorXd(x.tail(unknowns_.size())) : unknowns_), in_one_vector(before),
        time, x.head(state_size);
    const std::vector<double> values =
        replay<double>(conditions_, std::span<const double>(inputs.data(), static_cast<std::size_t>(inputs.size())));
    const Eigen::Map<const Eigen::VectorXd> all(values.data(), std::ssize(values));
    const Eigen::MatrixXd jacobian = all.tail(rows_ * solved_).reshaped(rows_, solved_);
    // Unknowns that the conditions do not read stay.
    const Eigen::VectorXd change = jacobian.completeOrthogonalDecomposition().solve(all.head(rows_));
    if (!change.allFinite()) break;
    x -= change;
    if (change.norm() > 1e-13 * (1.0 + x.norm())) continue;
    const Eigen::Index n = start.q.size();
    return {.q = x.head(n), .v = x.segment(n, n), .y = x.segment(2 * n, start.y.size())};
  }
  throw Error("Newton's method did not solve the conditions of a switch for the state after it within {} steps",
              most_steps);
}

}  // namespace dmocbench
