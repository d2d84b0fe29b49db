#include "methods/judgement/least_violation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "methods/judgement/kkt_residual.hpp"
#include "methods/kkt/sparse_kkt.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

namespace {

/// The longest step, at most 1, that leaves a hundredth of every distance.
double length_within(const Eigen::ArrayXd& distances, const Eigen::ArrayXd& changes) {
  constexpr double share = 0.99;
  double length = 1.0;
  for (Eigen::Index i = 0; i < distances.size(); ++i) {
    if (changes[i] < 0.0 && std::isfinite(distances[i])) length = std::min(length, -share * distances[i] / changes[i]);
  }
  return length;
}

/// z after a step to new distances: moved along its own linearisation, and kept near μ/d.
Eigen::ArrayXd moved_multipliers(const Eigen::ArrayXd& z, const Eigen::ArrayXd& distances, const Eigen::ArrayXd& change,
                                 const Eigen::ArrayXd& after, double mu) {
  constexpr double most = 1e3;
  const Eigen::ArrayXd step = (mu - z * change) / distances - z;
  const double length = length_within(z, step);
  return (z + length * step).max(mu / (most * after)).min(most * mu / after);
}

}  // namespace

ViolationDescent::ViolationDescent(NonlinearProgram& program, const Eigen::VectorXd& start)
    : program_(program),
      is_free_(free_variables(program)),
      lower_(program.variable_lower()),
      upper_(program.variable_upper()),
      factorisation_(kkt::dissection_order(program)) {
  constexpr double share = 1e-4;
  Eigen::VectorXd inside = start;
  for (Eigen::Index i = 0; i < inside.size(); ++i) {
    if (!is_free_[static_cast<std::size_t>(i)]) {
      inside[i] = lower_[i];
      lower_[i] = -unbounded;
      upper_[i] = unbounded;
      continue;
    }
    const double width = upper_[i] - lower_[i];
    const auto gap = [&](double bound) { return share * std::min(std::max(1.0, std::abs(bound)), width); };
    if (std::isfinite(lower_[i])) inside[i] = std::max(inside[i], lower_[i] + gap(lower_[i]));
    if (std::isfinite(upper_[i])) inside[i] = std::min(inside[i], upper_[i] - gap(upper_[i]));
  }
  at_ = values_at(program_, inside);
  differentiate(program_, at_);
  excess_ = violations(program_, at_.constraints);
  mark_ = excess_.squaredNorm();
}

/// μ falls with the mean of d z, but not below the resolution of the judgement of least violation.
void ViolationDescent::lower_barrier() {
  constexpr double centring = 0.1;
  constexpr double least_share = 1e-8;
  const Eigen::ArrayXd below = at_.point.array() - lower_;
  const Eigen::ArrayXd above = upper_ - at_.point.array();
  const double count = static_cast<double>(below.isFinite().count() + above.isFinite().count());
  if (count == 0.0) return;
  const double squared = excess_.squaredNorm();
  if (z_lower_.size() == 0) {
    mu_ = centring * squared / count;
    z_lower_ = mu_ / below;
    z_upper_ = mu_ / above;
    return;
  }
  const double products =
      below.isFinite().select(below * z_lower_, 0.0).sum() + above.isFinite().select(above * z_upper_, 0.0).sum();
  mu_ = std::max(centring * products, least_share * squared) / count;
}

double ViolationDescent::merit(const Linearisation& at) const {
  const Eigen::ArrayXd below = at.point.array() - lower_;
  const Eigen::ArrayXd above = upper_ - at.point.array();
  const double logarithms =
      below.isFinite().select(below.log(), 0.0).sum() + above.isFinite().select(above.log(), 0.0).sum();
  return 0.5 * violations(program_, at.constraints).squaredNorm() - mu_ * logarithms;
}

/// The lower triangle of (H + D, Jᵀ; J, -I), H the curvature of the violated rows. It has one negative eigenvalue per
/// row exactly if H + D + JᵀJ is positive definite.
Eigen::SparseMatrix<double> ViolationDescent::matrix(const Eigen::VectorXd& diagonal, bool with_curvature) {
  const auto n = static_cast<int>(at_.point.size());
  const auto m = static_cast<int>(excess_.size());
  const auto is_free = [&](Eigen::Index i) { return bool{is_free_[static_cast<std::size_t>(i)]}; };
  std::vector<Eigen::Triplet<double>> entries;
  // Without curvature the entries stay, as zeros: another pattern would be analysed again.
  Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program_.hessian_structure().size()));
  if (with_curvature) program_.hessian(at_.point, 0.0, excess_, values);
  program_.hessian_structure().for_each([&](Eigen::Index e, int i, int j) {
    if (is_free(i) && is_free(j)) entries.emplace_back(i, j, values[e]);
  });
  for (int j = 0; j < n; ++j) {
    entries.emplace_back(j, j, is_free(j) ? diagonal[j] : 1.0);
    for (Eigen::SparseMatrix<double>::InnerIterator entry(at_.jacobian, j); entry; ++entry) {
      // A row that holds does not count.
      const bool counts = is_free(j) && excess_[entry.row()] != 0.0;
      entries.emplace_back(n + static_cast<int>(entry.row()), j, counts ? entry.value() : 0.0);
    }
  }
  for (int i = 0; i < m; ++i) entries.emplace_back(n + i, n + i, -1.0);
  Eigen::SparseMatrix<double> lower(n + m, n + m);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

bool ViolationDescent::compute_step(bool with_curvature) {
  constexpr double least = 1e-12;
  const Eigen::ArrayXd below = at_.point.array() - lower_;
  const Eigen::ArrayXd above = upper_ - at_.point.array();
  const double damping =
      std::max(least, damping_ * excess_.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, below.size())));
  Eigen::VectorXd diagonal = damping / at_.point.array().abs().max(1.0).square();
  Eigen::VectorXd barrier = Eigen::VectorXd::Zero(diagonal.size());  // its gradient
  if (z_lower_.size() > 0) {
    diagonal.array() += z_lower_ / below + z_upper_ / above;
    barrier = mu_ / above - mu_ / below;
  }
  if (!factorisation_.factorise(matrix(diagonal, with_curvature))) return false;
  if (factorisation_.negative_eigenvalues() != excess_.size()) return false;
  Eigen::VectorXd right_hand_side(barrier.size() + excess_.size());
  right_hand_side << -barrier, -excess_;
  for (Eigen::Index i = 0; i < barrier.size(); ++i) {
    if (!is_free_[static_cast<std::size_t>(i)]) right_hand_side[i] = 0.0;
  }
  step_ = factorisation_.solve(std::move(right_hand_side)).head(barrier.size());
  directional_derivative_ = excess_.dot(at_.jacobian * step_) + barrier.dot(step_);
  return step_.allFinite() && directional_derivative_ < 0.0;
}

/// Backtracks along the step until the merit falls enough.
bool ViolationDescent::search() {
  constexpr double sufficient = 1e-4;
  constexpr double shortest = 1e-8;
  const Eigen::ArrayXd below = at_.point.array() - lower_;
  const Eigen::ArrayXd above = upper_ - at_.point.array();
  const double longest = std::min(length_within(below, step_), length_within(above, -step_));
  const double before = merit(at_);
  double length = longest;
  Linearisation trial;
  do {
    if (length < shortest * longest) return false;
    trial = values_at(program_, at_.point + length * step_);
    length *= 0.5;
  } while (!trial.has_finite_values() ||
           !(merit(trial) <= before + 2.0 * length * sufficient * directional_derivative_));
  length *= 2.0;

  const Eigen::VectorXd change = trial.point - at_.point;
  if (z_lower_.size() > 0) {
    z_lower_ = moved_multipliers(z_lower_, below, step_, trial.point.array() - lower_, mu_);
    z_upper_ = moved_multipliers(z_upper_, above, -step_, upper_ - trial.point.array(), mu_);
  }
  constexpr double most_damping = 1e6;
  constexpr double least_damping = 1e-10;
  is_long_ = length > 0.5 * longest;
  damping_ = is_long_ ? std::max(damping_ / 5.0, least_damping) : std::min(damping_ * 5.0, most_damping);
  at_ = std::move(trial);
  return true;
}

bool ViolationDescent::step() {
  if (!at_.has_finite_values()) return false;
  lower_barrier();
  const double before = excess_.squaredNorm();
  // Steps of Gauss and Newton are slow where rows cannot be met; those with curvature are short where it changes.
  constexpr double enough = 0.5;
  uses_curvature_ = uses_curvature_ ? is_long_ : left_ > enough;
  bool is_taken = uses_curvature_ && compute_step(true) && search();
  if (!is_taken) uses_curvature_ = false;
  constexpr int most_tries = 6;
  for (int i = 0; i < most_tries && !is_taken; ++i) {
    is_taken = compute_step(false) && search();
    if (!is_taken) damping_ *= 100.0;
  }
  left_ = 1.0;
  if (!is_taken) return false;
  differentiate(program_, at_);
  excess_ = violations(program_, at_.constraints);
  const double after = excess_.squaredNorm();
  left_ = before > 0.0 ? after / before : 1.0;
  constexpr double much = 0.8;
  ++slow_steps_;
  if (after <= much * mark_) {
    mark_ = after;
    slow_steps_ = 0;
  }
  return after > 0.0;
}

bool ViolationDescent::is_at_least_violation() const {
  constexpr double slow = 1.0 - 1e-6;
  return left_ > slow && is_point_of_least_violation(program_, at_.point);
}

namespace {

constexpr int most_steps = 200;

/// A descent that is cut short has shown nothing.
void require_time(const CountedProgram& program, const SolverOptions& options) {
  if ((options.stop_requested && options.stop_requested()) || program.is_out_of_time()) {
    throw Stopped("the descent on the constraint violation was stopped or reached the time limit");
  }
}

/// Descends from the solution's point; whether that ends at a point of least violation.
bool moves_to_least_violation(const CountedProgram& program, const SolverOptions& options, Solution& solution) {
  ViolationDescent descent(program.uncounted(), solution.primal);
  for (int i = 0; i < most_steps; ++i) {
    require_time(program, options);
    const bool is_over = !descent.step();
    if (descent.violation() <= options.tolerance) return false;
    if (descent.is_at_least_violation()) {
      solution.primal = descent.point();
      return true;
    }
    if (is_over) return false;
  }
  return false;
}

/// Where descent on the violation alone, from a point, meets the constraints; empty if it does not, or not soon where
/// it stalls and must not.
Eigen::VectorXd feasible_point_from(const CountedProgram& program, const SolverOptions& options,
                                    const Eigen::VectorXd& start, bool may_stall = true) {
  ViolationDescent descent(program.uncounted(), start);
  for (int i = 0; i < most_steps && descent.violation() > options.tolerance; ++i) {
    if (!may_stall && descent.has_stalled()) break;
    require_time(program, options);
    if (!descent.step()) break;
  }
  return descent.violation() <= options.tolerance ? descent.point() : Eigen::VectorXd();
}

/// A point with every unknown that has two bounds half way between them.
Eigen::VectorXd between_bounds(const NonlinearProgram& program, Eigen::VectorXd point) {
  for (Eigen::Index i = 0; i < point.size(); ++i) {
    const double middle = 0.5 * (program.variable_lower()[i] + program.variable_upper()[i]);
    if (std::isfinite(middle)) point[i] = middle;
  }
  return point;
}

/// A point with the unknowns of the whole horizon that are positive, such as T, multiplied by a factor, as far as their
/// bounds permit; empty if none moves.
Eigen::VectorXd stretched(const NonlinearProgram& program, Eigen::VectorXd point, double factor) {
  const IntervalStructure* structure = program.interval_structure();
  if (structure == nullptr) return {};
  bool moves = false;
  for (const PlaceRun& run : structure->unknowns.runs()) {
    if (run.kind != Place::Kind::border) continue;
    for (auto i = static_cast<Eigen::Index>(run.first); i < static_cast<Eigen::Index>(run.first + run.count); ++i) {
      const double lower = program.variable_lower()[i];
      const double upper = program.variable_upper()[i];
      const double wanted = std::clamp(factor * point[i], lower, upper);
      if (!(lower > 0.0) || wanted == point[i]) continue;
      point[i] = wanted;
      moves = true;
    }
  }
  return moves ? point : Eigen::VectorXd();
}

/// Whether no constraint is curved, neither at a point nor at another one, with multipliers that do not cancel: then
/// ½|r|² is convex, and where it is stationary it is least.
bool has_affine_constraints(NonlinearProgram& program, const Eigen::VectorXd& point) {
  // Irregular numbers between 0 and 1, of magnitudes that do not differ much.
  const auto irregular = [](Eigen::Index count) {
    constexpr double golden = 0.6180339887498949;
    Eigen::VectorXd numbers(count);
    for (Eigen::Index i = 0; i < count; ++i)
      numbers[i] = 0.25 + 0.5 * std::fmod(golden * static_cast<double>(i + 1), 1.0);
    return numbers;
  };
  const Eigen::VectorXd multipliers = irregular(static_cast<Eigen::Index>(program.constraint_count()));
  Eigen::VectorXd values(static_cast<Eigen::Index>(program.hessian_structure().size()));
  const Eigen::VectorXd shift = irregular(point.size()).array() * point.array().abs().max(1.0);
  for (const Eigen::VectorXd& at : {point, Eigen::VectorXd(point + shift)}) {
    program.hessian(at, 0.0, multipliers, values);
    if (!values.isZero(0.0)) return false;
  }
  return true;
}

}  // namespace

Eigen::VectorXd feasible_point(const CountedProgram& program, const SolverOptions& options,
                               const Eigen::VectorXd& start) {
  if (!start.allFinite()) return {};
  Eigen::VectorXd point = feasible_point_from(program, options, start);
  if (point.size() == 0) point = feasible_point_from(program, options, between_bounds(program.uncounted(), start));
  // Of linear dynamics the violation is convex in all unknowns but T.
  for (const double factor : {2.0, 4.0, 0.5, 8.0}) {
    const Eigen::VectorXd further =
        point.size() == 0 ? stretched(program.uncounted(), start, factor) : Eigen::VectorXd();
    if (further.size() > 0) point = feasible_point_from(program, options, further, false);
  }
  return point;
}

void judge_infeasibility(const CountedProgram& program, const SolverOptions& options, const Eigen::VectorXd& start,
                         Solution& solution) {
  const bool claims = solution.status == Status::infeasible;
  const bool has_failed = solution.status == Status::step_failed;
  if (!claims && !has_failed && solution.status != Status::iteration_limit) return;
  const bool is_outside = static_cast<std::size_t>(solution.primal.size()) == program.variable_count() &&
                          solution.primal.allFinite() &&
                          constraint_violation(program.uncounted(), solution.primal) > options.tolerance;
  const bool is_least =
      is_outside && (is_point_of_least_violation(program.uncounted(), solution.primal) ||
                     ((claims || has_failed) && moves_to_least_violation(program, options, solution)));
  const bool is_certain = is_least && has_affine_constraints(program.uncounted(), solution.primal);
  if (is_least && !is_certain && feasible_point(program, options, start).size() > 0) {
    solution.status = Status::step_failed;
    solution.message =
        "The last point is a local minimum of the constraint violation, but descent on the violation from another "
        "point reached a feasible point. The solver failed; start from another trajectory.";
    return;
  }
  if (!is_least && !claims) return;
  solution.status = is_least ? Status::infeasible : Status::step_failed;
  solution.message =
      is_certain ? "The program is infeasible: its constraints are affine and no point satisfies them. The last point "
                   "has the smallest violation."
      : is_least ? ""
                 : "The solver reports infeasibility, but its last point does not minimise the constraint violation.";
}

}  // namespace dmocbench
