#include "methods/adaptive/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "methods/adaptive/interval_conditions.hpp"
#include "methods/error.hpp"
#include "methods/judgement/linearised_conditions.hpp"
#include "methods/kkt/sparse_kkt.hpp"
#include "methods/mechanics/member_name.hpp"

namespace dmocbench {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A share of a quantity's size below which a difference is rounding.
constexpr double rounding_share = 1e-8;

/// The scale of a quantity's differences: its range, its size if constant, 1 if zero.
double scale_of(const Eigen::MatrixXd& nodes) {
  const double size = nodes.lpNorm<Eigen::Infinity>();
  const double range = (nodes.colwise().maxCoeff() - nodes.colwise().minCoeff()).norm();
  if (range > rounding_share * std::max(1.0, size)) return range;
  return size > rounding_share ? size : 1.0;
}

/// `ErrorEstimate::floor`.
double rounding_floor(const Transcription& program, const Trajectory& motion) {
  constexpr double safety_of_floors = 20.0;
  return program.rounding_floors().largest / safety_of_floors / scale_of(motion.p);
}

double largest_row(const Eigen::MatrixXd& rows) { return rows.rowwise().norm().maxCoeff(); }

/// The misses of the next node by the replayed intervals, row k for interval k; costates times the cost scale.
struct Misses {
  ExtremalStates in_velocities;
  ExtremalCoordinates::Canonical in_momenta;
};

/// The intervals of a motion replayed from their first nodes.
struct ReplayedIntervals {
  ExtremalStates nodes;  // of the motion
  Eigen::VectorXd cost;  // of each interval, times the cost scale
  Misses misses;
};

ReplayedIntervals replayed(ExtremalFlow& flow, ExtremalCoordinates& coordinates, const Trajectory& motion,
                           double cost_scale) {
  constexpr double tolerance = 1e-12;
  const Eigen::Index intervals = motion.intervals();
  const ExtremalStates nodes = coordinates.of_nodes(motion);
  const ExtremalFlow::CarriedNodes carried = flow.carry(nodes, motion, tolerance);
  const auto canonical = coordinates.canonical(carried.states, motion.node_times.tail(intervals));
  const auto missed = [&](const Eigen::MatrixXd& there, const Eigen::MatrixXd& at_nodes) -> Eigen::MatrixXd {
    return there - at_nodes.bottomRows(intervals);
  };
  return {nodes,
          carried.cost,
          {{missed(carried.states.q, nodes.q), missed(carried.states.v, nodes.v),
            missed(carried.states.alpha, nodes.alpha), missed(carried.states.beta, nodes.beta)},
           {missed(canonical.q, motion.q), missed(canonical.p, motion.p),
            missed(canonical.psi_q, cost_scale * motion.psi_q), missed(canonical.psi_p, cost_scale * motion.psi_p)}}};
}

/// `ErrorEstimate::defects`; infinite where an interval could not be replayed.
Eigen::VectorXd defects_of(const ReplayedIntervals& replay, const Trajectory& motion, double cost_scale) {
  Eigen::VectorXd defects = Eigen::VectorXd::Zero(replay.cost.size());
  const auto count = [&](const Eigen::MatrixXd& misses, const Eigen::MatrixXd& nodes) {
    defects = defects.cwiseMax(misses.rowwise().norm() / scale_of(nodes));
  };
  const auto& misses = replay.misses.in_momenta;
  count(misses.q, motion.q);
  count(misses.p, motion.p);
  count(misses.psi_q, cost_scale * motion.psi_q);
  count(misses.psi_p, cost_scale * motion.psi_p);
  const Eigen::VectorXd sums = misses.q.rowwise().sum() + misses.p.rowwise().sum() + misses.psi_q.rowwise().sum() +
                               misses.psi_p.rowwise().sum() + replay.cost;
  for (Eigen::Index k = 0; k < defects.size(); ++k) {
    if (!std::isfinite(sums[k])) defects[k] = infinite;
  }
  return defects;
}

/// The node's part of the misses in the unknowns of a family, and their change in the equations of the next node
/// itself: `moved` is by how far the interval's last node is moved, `jumps` the change of the equations.
struct Perturbation {
  LocalValues moved;
  LocalValues jumps;
};

Perturbation perturbation_of(const Misses& misses, NodeState family, LocalValues zero) {
  Perturbation result{zero, std::move(zero)};
  const auto& canonical = misses.in_momenta;
  const Eigen::Index n = canonical.q.cols();
  if (family == NodeState::configuration) {
    // The rows of the node are its momentum, and their multipliers ψ^p.
    result.moved.unknowns.middleCols(n, n) = canonical.q;
    result.moved.rows.middleCols(n, n) = canonical.psi_p;
    result.jumps.rows.middleCols(n, n) = canonical.p;
    result.jumps.unknowns.middleCols(n, n) = -canonical.psi_q;
    return result;
  }
  const bool has_momenta = family == NodeState::momentum;
  const ExtremalStates& states = misses.in_velocities;
  result.moved.unknowns.middleCols(2 * n, n) = canonical.q;
  result.moved.unknowns.middleCols(3 * n, n) = has_momenta ? canonical.p : states.v;
  result.jumps.unknowns.middleCols(2 * n, n) = -(has_momenta ? canonical.psi_q : states.alpha);
  result.jumps.unknowns.middleCols(3 * n, n) = -(has_momenta ? canonical.psi_p : states.beta);
  return result;
}

/// Row k of `first` for node k, and one more below.
Eigen::MatrixXd with_last(const Eigen::MatrixXd& first, const Eigen::RowVectorXd& last) {
  Eigen::MatrixXd rows(first.rows() + 1, first.cols());
  rows << first, last;
  return rows;
}

/// The change of the answer that a change of all conditions makes.
struct PrimalDualStep {
  Eigen::VectorXd primal;
  Eigen::VectorXd multipliers;
};

/// The step from the answer to where the conditions with the perturbation hold.
PrimalDualStep step_to_optimum(const Transcription& program, const LinearisedConditions& at,
                               const IntervalConditions& conditions, const Perturbation& perturbation) {
  LocalValues change = conditions.times(perturbation.moved);
  change.unknowns -= perturbation.jumps.unknowns;
  change.rows -= perturbation.jumps.rows;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(at.gradient.size());
  Eigen::VectorXd constraints = Eigen::VectorXd::Zero(at.constraints.size());
  conditions.add(change, gradient, constraints);
  gradient *= -1.0;
  constraints *= -1.0;
  PrimalDualStep step{Eigen::VectorXd::Zero(gradient.size()), Eigen::VectorXd::Zero(constraints.size())};
  const auto solves = [&](kkt::KktSystem& system) {
    system.begin_solve();
    return system.solve(kkt_matrix_of(at), {gradient, constraints}, {step.primal, step.multipliers}) ==
           kkt::FactorisationStatus::solved;
  };
  const auto by_intervals = kkt_system_by_intervals(program);
  if ((by_intervals && solves(*by_intervals)) || solves(*kkt_system_of_any_point(program))) return step;
  throw Error("the error of the solution cannot be estimated: the matrix of its optimality conditions is singular");
}

void require_smooth_optimum(const Transcription& program, const LinearisedConditions& at) {
  constexpr double active = 1e-3;  // a multiplier over the distance from the bound
  const auto is_active = [&](const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const auto& stiffness) {
    for (Eigen::Index j = 0; j < lower.size(); ++j) {
      if (lower[j] < upper[j] && stiffness(j) > active) return true;
    }
    return false;
  };
  if (is_active(program.variable_lower(), program.variable_upper(), [&](Eigen::Index j) { return at.diagonal[j]; }) ||
      is_active(program.constraint_lower(), program.constraint_upper(),
                [&](Eigen::Index i) { return 1.0 / at.compliance[i]; })) {
    throw Error(
        "the error can be estimated only if no bound or inequality is active along the optimum; widen the bounds, or "
        "choose the grid yourself");
  }
}

/// The estimate's error of states and costates, from the change of the unknowns and multipliers.
struct NodeErrors {
  ExtremalCoordinates::Canonical canonical;  // differences; set later for velocity families
  ExtremalStates in_velocities;
};

NodeErrors errors_at_nodes(const Transcription& program, const IntervalConditions& conditions,
                           const PrimalDualStep& step, const Perturbation& perturbation, const Misses& misses) {
  const ProgramBlocks& blocks = program.blocks();
  const NodeState family = program.node_state();
  const Eigen::Index n = misses.in_momenta.q.cols();
  const auto nodes = static_cast<Eigen::Index>(blocks.intervals()) + 1;
  const Eigen::Index last = nodes - 2;
  LocalValues direction = conditions.picked(step.primal, step.multipliers);
  direction.unknowns -= perturbation.moved.unknowns;
  direction.rows -= perturbation.moved.rows;
  const LocalValues change = conditions.times(direction);
  const auto costate = [&](Eigen::Index left, Eigen::Index right) {
    return with_last(change.unknowns.middleCols(left, n), -change.unknowns.row(last).segment(right, n) -
                                                              perturbation.jumps.unknowns.row(last).segment(right, n));
  };
  const Eigen::MatrixXd q = blocks.unknown(Quantity::configuration).columns(step.primal, nodes);
  if (family == NodeState::configuration) {
    return {
        {q, with_last(-change.rows.leftCols(n), change.rows.row(last).segment(n, n) + misses.in_momenta.p.row(last)),
         costate(0, n), blocks.row(Equation::euler_lagrange).columns(step.multipliers, nodes)},
        {}};
  }
  const Eigen::MatrixXd second = blocks.unknown(Quantity::second).columns(step.primal, nodes);
  const Eigen::MatrixXd first_costate = costate(0, 2 * n);
  const Eigen::MatrixXd second_costate = costate(n, 3 * n);
  if (family == NodeState::momentum) return {{q, second, first_costate, second_costate}, {}};
  return {{}, {q, second, first_costate, second_costate}};
}

/// ½ Σ_k [δψ_{k+1}·m^x_k - m^ψ_k·(δx_{k+1} - m^x_k)] of misses m and errors δ at the nodes: half the derivative of the
/// Lagrangian at the answer along its error, which makes the estimate of the cost exact to second order.
double second_order_of_cost(const ExtremalCoordinates::Canonical& misses,
                            const ExtremalCoordinates::Canonical& errors) {
  const auto product = [&](const Eigen::MatrixXd& of_misses, const Eigen::MatrixXd& of_errors) {
    return of_misses.cwiseProduct(of_errors.bottomRows(of_misses.rows())).sum();
  };
  const double by_costates = product(misses.q, errors.psi_q) + product(misses.p, errors.psi_p);
  const double by_states = product(misses.psi_q, errors.q) + product(misses.psi_p, errors.p);
  const double of_misses = misses.q.cwiseProduct(misses.psi_q).sum() + misses.p.cwiseProduct(misses.psi_p).sum();
  return 0.5 * (by_costates - by_states + of_misses);
}

/// The program, unless its horizon is free or its ends are tied.
const Transcription& with_fixed_ends(const Transcription& program) {
  if (program.has_free_horizon()) throw Error("the error cannot be estimated for a free horizon; set a fixed horizon");
  program.traced_problem().require_no_constraints("error estimation");
  if (program.traced_problem().boundary_condition_count() > 0) {
    throw Error("the error cannot be estimated for a problem with boundary conditions; state the ends with " +
                member_name("initial_state") + ", " + member_name("final_state") + " and bounds");
  }
  return program;
}

}  // namespace

double relative_size(const Trajectory& answer, const Eigen::MatrixXd& q, const Eigen::MatrixXd& p, double objective,
                     double cost_scale) {
  const double cost = std::max(std::abs(answer.cost), rounding_share / cost_scale);
  const double of_motion = std::max(largest_row(q) / scale_of(answer.q), largest_row(p) / scale_of(answer.p));
  const double largest = std::max(of_motion, std::abs(objective) / cost);
  if (!std::isfinite(largest)) return infinite;
  return largest;
}

ErrorEstimate error_by_comparison(const Transcription& program, const Trajectory& earlier, const Trajectory& later) {
  const Eigen::Index stride = later.intervals() / earlier.intervals();
  const auto at_earlier_nodes = [&](const Eigen::MatrixXd& nodes) -> Eigen::MatrixXd {
    Eigen::MatrixXd picked(earlier.q.rows(), nodes.cols());
    for (Eigen::Index k = 0; k < picked.rows(); ++k) picked.row(k) = nodes.row(k * stride);
    return picked;
  };
  ErrorEstimate estimate{.q = at_earlier_nodes(later.q) - earlier.q,
                         .p = at_earlier_nodes(later.p) - earlier.p,
                         .objective = later.cost - earlier.cost};
  const double horizon = later.node_times[later.intervals()];
  const double of_horizon = std::abs(horizon - earlier.node_times[earlier.intervals()]) / horizon;
  const double of_motion = relative_size(later, estimate.q, estimate.p, estimate.objective, program.cost_scale());
  estimate.relative = std::max(of_motion, of_horizon);
  estimate.floor = rounding_floor(program, later);
  return estimate;
}

ErrorEstimator::ErrorEstimator(const Transcription& program)
    : cost_scale_(with_fixed_ends(program).cost_scale()),
      flow_(program.traced_problem(), cost_scale_),
      coordinates_(program.traced_problem(), cost_scale_) {}

ErrorEstimate ErrorEstimator::estimate(Transcription& program, const Eigen::VectorXd& primal,
                                       const Eigen::VectorXd& multipliers, const Trajectory& motion) {
  const TracedProblem& traced = program.traced_problem();
  if (program.functions().mayer) throw Error("the error can be estimated only in Bolza form; use --form bolza");
  if (traced.integral_count() > 0 || traced.unknown_count() > 0 || traced.first_order_size() > 0) {
    throw Error("the error cannot be estimated with integral constraints, unknown parameters or first-order states");
  }
  if (!program.bounds().interior.empty()) {
    throw Error("the error cannot be estimated with bounds between the ends, because costates jump there");
  }
  const LinearisedConditions at(program, primal, multipliers);
  require_smooth_optimum(program, at);
  ErrorEstimate estimate;
  estimate.floor = rounding_floor(program, motion);
  const ReplayedIntervals replay = replayed(flow_, coordinates_, motion, cost_scale_);
  estimate.defects = defects_of(replay, motion, cost_scale_);
  if (!estimate.defects.allFinite()) {
    for (Eigen::MatrixXd* const part : {&estimate.q, &estimate.p, &estimate.psi_q, &estimate.psi_p}) {
      part->setConstant(motion.q.rows(), motion.q.cols(), infinite);
    }
    estimate.objective = infinite;
    estimate.relative = infinite;
    return estimate;
  }

  const IntervalConditions conditions(program, primal, multipliers);
  const Perturbation perturbation = perturbation_of(replay.misses, program.node_state(), conditions.zero());
  const PrimalDualStep step = step_to_optimum(program, at, conditions, perturbation);
  const NodeErrors errors = errors_at_nodes(program, conditions, step, perturbation, replay.misses);
  const auto canonical = program.node_state() == NodeState::velocity
                             ? in_momenta(replay.nodes, errors.in_velocities, motion)
                             : errors.canonical;
  estimate.q = canonical.q;
  estimate.p = canonical.p;
  estimate.psi_q = canonical.psi_q / cost_scale_;
  estimate.psi_p = canonical.psi_p / cost_scale_;

  const Eigen::Index intervals = motion.intervals();
  const Eigen::VectorXd costs = program.tabulate(program.functions().cost, primal).col(0);
  const double worth = (replay.nodes.alpha.bottomRows(intervals).cwiseProduct(replay.misses.in_velocities.q) +
                        replay.nodes.beta.bottomRows(intervals).cwiseProduct(replay.misses.in_velocities.v))
                           .sum();
  const double second = second_order_of_cost(replay.misses.in_momenta, canonical);
  estimate.objective = ((replay.cost - costs).sum() + worth + second) / cost_scale_;
  estimate.relative = relative_size(motion, estimate.q, estimate.p, estimate.objective, cost_scale_);
  return estimate;
}

/// Errors of (q, v, α, β) as errors of (q, p, ψ^q, ψ^p).
ExtremalCoordinates::Canonical ErrorEstimator::in_momenta(const ExtremalStates& nodes, const ExtremalStates& errors,
                                                          const Trajectory& motion) {
  const auto here = coordinates_.canonical(nodes, motion.node_times);
  const auto there = coordinates_.canonical(
      {nodes.q + errors.q, nodes.v + errors.v, nodes.alpha + errors.alpha, nodes.beta + errors.beta},
      motion.node_times);
  return {errors.q, there.p - here.p, there.psi_q - here.psi_q, there.psi_p - here.psi_p};
}

}  // namespace dmocbench
