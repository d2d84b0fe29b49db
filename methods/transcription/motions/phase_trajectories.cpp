#include "methods/transcription/motions/phase_trajectories.hpp"

#include <limits>
#include <string>
#include <utility>

namespace dmocbench {

namespace {

/// Columns of a table that may have none.
Eigen::MatrixXd columns(const Eigen::MatrixXd& table, const PhasedProblem::Slice& slice, double factor = 1.0) {
  if (table.cols() == 0) return table;
  return factor * table.middleCols(slice.first, slice.size);
}

/// The value of an unknown of the whole, or of its price.
double of_unknown(const PhasedProblem& problem, const Eigen::VectorXd& values, const std::string& name) {
  const std::vector<std::size_t> unknowns = problem.unknowns();
  for (std::size_t i = 0; i < unknowns.size() && static_cast<Eigen::Index>(i) < values.size(); ++i) {
    if (problem.parameters()[unknowns[i]].name == name) return values[static_cast<Eigen::Index>(i)];
  }
  return 0.0;
}

Eigen::VectorXd own_unknowns(const PhasedProblem& problem, std::size_t i, const Eigen::VectorXd& values) {
  const Problem& phase = *problem.phases()[i].problem;
  const std::vector<std::size_t> unknowns = phase.unknowns();
  Eigen::VectorXd own(values.size() == 0 ? 0 : std::ssize(unknowns));
  for (Eigen::Index j = 0; j < own.size(); ++j) {
    own[j] = of_unknown(problem, values, phase.parameters()[unknowns[static_cast<std::size_t>(j)]].name);
  }
  return own;
}

/// The multipliers of bounds on velocities, which are path constraints of a phase with a free duration; n columns.
Eigen::MatrixXd prices_of_velocities(const PhasedProblem& problem, std::size_t i, const BoundMultipliers& all,
                                     double share) {
  const PhasedProblem::Part& part = problem.parts()[i];
  if (!part.is_free) return columns(all.stage_v, part.q);
  if (part.bounded_velocities.size == 0 || all.path.size() == 0) return {};
  const std::vector<Eigen::Index> bounded = problem.bounded_velocities(i);
  Eigen::MatrixXd prices = Eigen::MatrixXd::Zero(all.path.rows(), part.q.size);
  for (std::size_t k = 0; k < bounded.size(); ++k) {
    prices.col(bounded[k]) = all.path.col(part.bounded_velocities.first + static_cast<Eigen::Index>(k)) / share;
  }
  return prices;
}

BoundMultipliers own_prices(const PhasedProblem& problem, std::size_t i, const BoundMultipliers& all, double share) {
  const PhasedProblem::Part& part = problem.parts()[i];
  // Per unit and time, which passes faster or slower here.
  return {.q = columns(all.q, part.q),
          .v = columns(all.v, part.q, share),
          .y = columns(all.y, part.y),
          .stage_v = prices_of_velocities(problem, i, all, share),
          .stage_u = columns(all.stage_u, part.u, 1.0 / share),
          .path = columns(all.path, part.path, 1.0 / share),
          .unknowns = own_unknowns(problem, i, all.unknowns),
          .horizon = of_unknown(problem, all.unknowns, problem.name_of_duration(i))};
}

}  // namespace

std::vector<PhaseTrajectory> phase_trajectories(const PhasedProblem& problem, const Trajectory& all) {
  const ParameterScope scope = with_unknowns(problem, all.unknowns);
  const auto number = [](const Expression& formula) {
    return formula.constant_value().value_or(std::numeric_limits<double>::quiet_NaN());
  };
  std::vector<PhaseTrajectory> phases;
  for (std::size_t i = 0; i < problem.phases().size(); ++i) {
    const PhasedProblem::Part& part = problem.parts()[i];
    const double share = number(problem.duration(i)) / problem.horizon();
    Trajectory own;
    own.tableau = all.tableau;
    own.node_times = share * all.node_times;
    own.stage_times = share * all.stage_times;
    for (const auto& [name, values, kind, is_per_time] : trajectory_tables) {
      const PhasedProblem::Slice& slice = kind == 'q' ? part.q : kind == 'u' ? part.u : part.y;
      own.*values = columns(all.*values, slice, is_per_time ? 1.0 / share : 1.0);
    }
    own.cost = std::numeric_limits<double>::quiet_NaN();
    own.unknowns = own_unknowns(problem, i, all.unknowns);
    own.prices = own_prices(problem, i, all.prices, share);
    phases.push_back({.start = number(problem.start_time(i)), .motion = std::move(own)});
  }
  return phases;
}

}  // namespace dmocbench
