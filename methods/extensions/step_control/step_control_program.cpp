#include "methods/extensions/step_control/step_control_program.hpp"

#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "methods/error.hpp"
#include "methods/expression/replay.hpp"
#include "methods/extensions/step_control/extended_action.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/transcription/derivatives/local_functions.hpp"
#include "methods/transcription/derivatives/part_places.hpp"
#include "methods/transcription/program_bounds.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

void require_plain(const Problem& problem, const TracedProblem& traced) {
  const ProblemBounds bounds = problem_bounds(problem);
  const bool is_plain = bounds.first.all_fixed() && bounds.last.all_fixed() && !bounds.horizon.is_free() &&
                        !bounds.q.any() && !bounds.v.any() && !bounds.u.any() && traced.path_constraint_count() == 0 &&
                        traced.boundary_condition_count() == 0 && traced.integral_count() == 0 &&
                        traced.unknown_count() == 0 && traced.first_order_size() == 0 && traced.constraint_count() == 0;
  if (is_plain) return;
  throw Error(
      "variational step sizes are supported only for problems with fixed ends, a fixed horizon and no constraints; " +
      problem.name() + " is not such a problem");
}

ExpressionVector single(const Expression& entry) { return ExpressionVector::Constant(1, entry); }

}  // namespace

StepControlProgram::StepControlProgram(const Problem& problem, Tableau tableau, StepFunction sigma,
                                       std::size_t intervals)
    : problem_(problem),
      traced_(problem),
      tableau_(std::move(tableau)),
      sigma_(std::move(sigma)),
      n_(traced_.configuration_size()),
      m_(traced_.control_size()),
      intervals_(static_cast<Eigen::Index>(intervals)),
      unread_(Eigen::VectorXd::Zero(intervals_)) {
  require_plain(problem, traced_);
  place();
  trace();
  fix_ends();
}

void StepControlProgram::place() {
  using enum Place::Kind;
  structure_.intervals = static_cast<std::size_t>(intervals_);
  const auto append = [&](Places& places, Place::Kind kind, Eigen::Index count) {
    const std::size_t first = places.size();
    const std::size_t length = structure_.intervals + (kind == node ? 1 : 0);
    for (Eigen::Index i = 0; i < count; ++i) places.append(kind, 0, length);
    return first;
  };
  const Eigen::Index s = tableau_.stages();
  columns_.q = append(structure_.unknowns, node, n_);
  columns_.t = append(structure_.unknowns, node, 1);
  columns_.rates = append(structure_.unknowns, interval, (s - 1) * n_);
  columns_.controls = append(structure_.unknowns, interval, s * m_);
  columns_.multiplier = append(structure_.unknowns, interval, 1);
  columns_.pace = structure_.unknowns.append(border, 0, 1);
  columns_.momentum_rows = append(structure_.rows, node, n_);
  columns_.energy_rows = append(structure_.rows, node, 1);
  columns_.rate_rows = append(structure_.rows, interval, (s - 1) * n_);
  columns_.step_rows = append(structure_.rows, interval, 1);
}

struct StepControlProgram::TracedUnknowns {
  IntervalUnknowns interval;
  ExpressionVector left_t, right_t;  // one entry each
  Expression multiplier;             // of the rule of the step
  Expression pace;
  std::vector<SeriesPlace> places;  // in the program's vector
};

StepControlProgram::TracedUnknowns StepControlProgram::take_unknowns() const {
  TracedUnknowns all;
  InputCounter counter;
  const auto take = [&](Eigen::Index first, Eigen::Index length, std::size_t right, Eigen::Index count) {
    for (Eigen::Index i = 0; i < count; ++i) {
      all.places.emplace_back(static_cast<std::size_t>(first + i * length) + right);
    }
    return counter.take(count);
  };
  const Eigen::Index nodes = intervals_ + 1;
  const auto at_node = [&](std::size_t column, std::size_t right, Eigen::Index count) {
    return take(head(column, 0, nodes), nodes, right, count);
  };
  const auto of_stage = [&](std::size_t column, Eigen::Index stage, Eigen::Index count) {
    return take(head(column, stage * count, intervals_), intervals_, 0, count);
  };
  IntervalUnknowns& interval = all.interval;
  interval.left_q = at_node(columns_.q, 0, n_);
  all.left_t = at_node(columns_.t, 0, 1);
  interval.right_q = at_node(columns_.q, 1, n_);
  all.right_t = at_node(columns_.t, 1, 1);
  const Eigen::Index s = tableau_.stages();
  for (Eigen::Index j = 0; j + 1 < s; ++j) interval.rates_q.push_back(of_stage(columns_.rates, j, n_));
  for (Eigen::Index i = 0; i < s; ++i) interval.controls.push_back(of_stage(columns_.controls, i, m_));
  all.multiplier = of_stage(columns_.multiplier, 0, 1)[0];
  all.places.emplace_back(columns_.pace, true);
  all.pace = counter.take();
  interval.t = all.left_t[0];
  interval.h = all.right_t[0] - all.left_t[0];
  return all;
}

/// The rows in the order of the formulas: rows of both nodes, of the stage rates, of the step.
std::vector<SeriesPlace> StepControlProgram::places_of_local_rows() const {
  std::vector<SeriesPlace> rows;
  const auto add = [&](std::size_t column, Eigen::Index length, std::size_t right_node, Eigen::Index count) {
    for (Eigen::Index i = 0; i < count; ++i) {
      rows.emplace_back(static_cast<std::size_t>(head(column, i, length)) + right_node);
    }
  };
  for (const std::size_t right_node : {0U, 1U}) {
    add(columns_.momentum_rows, intervals_ + 1, right_node, n_);
    add(columns_.energy_rows, intervals_ + 1, right_node, 1);
  }
  add(columns_.rate_rows, intervals_, 0, (tableau_.stages() - 1) * n_);
  add(columns_.step_rows, intervals_, 0, 1);
  return rows;
}

void StepControlProgram::trace() {
  const TracedUnknowns unknowns = take_unknowns();
  const IntervalUnknowns& interval = unknowns.interval;
  const ExtendedAction action(problem_, traced_, tableau_, interval);
  const Expression c = interval.h - unknowns.pace * action.mean_of(sigma_);
  const auto vary = [&](const ExpressionVector& x) { return action.variation_by(x, c, unknowns.multiplier); };
  const ExpressionVector left = vary(interval.left_q);
  const ExpressionVector right = vary(interval.right_q);
  std::vector<ExpressionVector> formulas{left, vary(unknowns.left_t), right, vary(unknowns.right_t)};
  for (std::size_t j = 0; j < interval.rates_q.size(); ++j) {
    const Expression weight = interval.h * Expression(tableau_.b[static_cast<Eigen::Index>(j)]);
    formulas.emplace_back(vary(interval.rates_q[j]) / weight);
  }
  formulas.push_back(single(c));
  assemble(differentiate(Expression(problem_.cost_scale()) * action.element().cost, stacked(formulas),
                         unknowns.places.size(), 0),
           unknowns.places, places_of_local_rows());

  std::vector<ExpressionVector> read{-left, right};
  for (const ControlledState& stage : action.element().stages) {
    read.insert(read.end(), {stage.q, stage.v, single(stage.t)});
  }
  reading_ = Schedule(stacked(read));
}

void StepControlProgram::assemble(const LocalFunctions& functions, const std::vector<SeriesPlace>& unknowns,
                                  const std::vector<SeriesPlace>& rows) {
  jacobian_ = assemble_pattern(jacobian_entries(functions, rows, unknowns, structure_.intervals));
  hessian_ = assemble_pattern(hessian_entries(functions, unknowns, structure_.intervals));
  const ProgramArrays arrays{.variables = variable_count(),
                             .constraints = constraint_count(),
                             .jacobian = jacobian_.pattern.size(),
                             .hessian = hessian_.pattern.size()};
  PartPlaces places =
      part_places(functions, unknowns, rows, jacobian_.places, hessian_.places, arrays, structure_.intervals);
  part_ = std::make_unique<ProgramPart>(functions, std::move(places), unread_, unread_, unread_, "tape");
}

void StepControlProgram::fix_ends() {
  variables_ = Bounds::none(static_cast<Eigen::Index>(variable_count()));
  rows_ = Bounds::fixed(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(constraint_count())));
  const auto fix = [](Bounds& bounds, Eigen::Index i, double value) { bounds.lower[i] = bounds.upper[i] = value; };
  LegendreTransform legendre(traced_);
  const double horizon = problem_.horizon();
  const auto fix_end = [&](const BoundaryState& end, Eigen::Index node, double t, double sign) {
    Eigen::VectorXd momentum = legendre.momentum(end.q, end.v, t);
    for (Eigen::Index i = 0; i < n_; ++i) {
      fix(variables_, head(columns_.q, i, intervals_ + 1) + node, end.q[i]);
      fix(rows_, head(columns_.momentum_rows, i, intervals_ + 1) + node, sign * momentum[i]);
    }
    fix(variables_, head(columns_.t, 0, 0) + node, t);
    return momentum;
  };
  const BoundaryState first = problem_.initial_state();
  const Eigen::VectorXd momentum = fix_end(first, 0, 0.0, -1.0);
  static_cast<void>(fix_end(problem_.final_state(), intervals_, horizon, 1.0));

  InputCounter counter;
  const State state{counter.take(n_), counter.take(n_), counter.take()};
  const Schedule lagrangian(single(problem_.lagrangian(state)));
  std::vector<double> inputs(first.q.begin(), first.q.end());
  inputs.insert(inputs.end(), first.v.begin(), first.v.end());
  inputs.push_back(0.0);
  const double energy = momentum.dot(first.v) - replay<double>(lagrangian, std::span<const double>(inputs)).front();
  fix(rows_, head(columns_.energy_rows, 0, 0), energy);
  // The final energy is free, but interior-point methods need a bound for a constraint that is not an equality: a far
  // one.
  constexpr double far = 1e3;
  const Eigen::Index last = head(columns_.energy_rows, 0, 0) + intervals_;
  rows_.lower[last] = -far * (1.0 + std::abs(energy));
  rows_.upper[last] = far * (1.0 + std::abs(energy));
}

Eigen::VectorXd StepControlProgram::start(const Motion& motion) const {
  const StepTimes steps = step_times(sigma_, motion, intervals_);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(variable_count()));
  for (Eigen::Index k = 0; k <= intervals_; ++k) {
    const MotionPoint point = motion.at(steps.times[k]);
    for (Eigen::Index i = 0; i < n_; ++i) x[head(columns_.q, i, intervals_ + 1) + k] = point.q[i];
    x[head(columns_.t, 0, 0) + k] = steps.times[k];
  }
  const Eigen::Index s = tableau_.stages();
  for (Eigen::Index k = 0; k < intervals_; ++k) {
    const double h = steps.times[k + 1] - steps.times[k];
    for (Eigen::Index j = 0; j < s; ++j) {
      const MotionPoint stage = motion.at(steps.times[k] + tableau_.c[j] * h);
      for (Eigen::Index i = 0; i < m_; ++i) x[head(columns_.controls, j * m_ + i, intervals_) + k] = stage.u[i];
      for (Eigen::Index i = 0; i < n_ && j + 1 < s; ++i) {
        x[head(columns_.rates, j * n_ + i, intervals_) + k] = stage.v[i];
      }
    }
  }
  x[head(columns_.pace, 0, 0)] = steps.pace;
  return x.cwiseMax(variables_.lower).cwiseMin(variables_.upper);
}

Trajectory StepControlProgram::read(const Eigen::VectorXd& x) {
  if (static_cast<std::size_t>(x.size()) != variable_count()) {
    throw Error("a trajectory needs {} variables, got {}", variable_count(), x.size());
  }
  const Eigen::MatrixXd table = Tape(reading_).table(intervals_, part_->bind(x, Eigen::VectorXd(), 1.0));

  const Eigen::Index s = tableau_.stages();
  Trajectory motion;
  motion.tableau = tableau_;
  motion.node_times = x.segment(head(columns_.t, 0, 0), intervals_ + 1);
  motion.q = x.segment(head(columns_.q, 0, 0), n_ * (intervals_ + 1)).reshaped(intervals_ + 1, n_);
  motion.p.resize(intervals_ + 1, n_);
  motion.p.topRows(intervals_) = table.leftCols(n_);
  motion.p.row(intervals_) = table.block(intervals_ - 1, n_, 1, n_);
  motion.stage_times.resize(intervals_ * s);
  motion.stage_q.resize(intervals_ * s, n_);
  motion.stage_v.resize(intervals_ * s, n_);
  motion.stage_u.resize(intervals_ * s, m_);
  for (Eigen::Index i = 0; i < s; ++i) {
    const auto rows = Eigen::seqN(i, intervals_, s);
    const auto stage = table.middleCols(2 * n_ + i * (2 * n_ + 1), 2 * n_ + 1);
    motion.stage_q(rows, Eigen::all) = stage.leftCols(n_);
    motion.stage_v(rows, Eigen::all) = stage.middleCols(n_, n_);
    motion.stage_times(rows) = stage.col(2 * n_);
    for (Eigen::Index c = 0; c < m_; ++c) {
      motion.stage_u(rows, c) = x.segment(head(columns_.controls, i * m_ + c, intervals_), intervals_);
    }
  }
  add_velocities(traced_, motion);
  motion.cost = objective(x) / problem_.cost_scale();
  return motion;
}

}  // namespace dmocbench
