#include "methods/judgement/newton_correction.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include "methods/judgement/linearised_conditions.hpp"
#include "methods/kkt/newton_residual.hpp"
#include "methods/kkt/sparse_kkt.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

namespace {

using kkt::FactorisationStatus;

/// The share of the largest entry of the Hessian that is added to its diagonal where eliminations lose the curvature
/// along a control to rounding, as on a singular arc.
constexpr double rounding_of_curvature = 1e-9;
/// The length at which a step with that shift settles the answer: where the curvature is at least 1e-4 of the shift,
/// 1e-13 of the largest entry, the step without a shift is then at most about `settled`.
constexpr double surely_settled = 1e-4 * settled;

double largest(const Eigen::VectorXd& x) { return x.size() > 0 ? x.lpNorm<Eigen::Infinity>() : 0.0; }

}  // namespace

NewtonCorrections::NewtonCorrections(NonlinearProgram& program, Factorisation factorisation)
    : program_(program),
      by_intervals_(factorisation == Factorisation::sparse ? nullptr : kkt_system_by_intervals(program)) {}
NewtonCorrections::~NewtonCorrections() = default;

std::optional<double> NewtonCorrections::length_at(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers,
                                                   const KktMemory& memory) {
  conditions_.compute(program_, primal, multipliers, memory);
  step_.primal.setZero(primal.size());
  step_.multipliers.setZero(multipliers.size());
  has_minimum_ = false;
  if (!conditions_.is_finite()) return unbounded;
  const auto solved_or_failed = [&](kkt::KktSystem& system, const kkt::KktMatrix& matrix) {
    try {
      system.begin_solve();
      return system.solve(matrix, {conditions_.gradient, conditions_.constraints}, {step_.primal, step_.multipliers});
    } catch (const Stopped&) {
      throw;
    } catch (const std::exception&) {  // the factorisation is out of memory, or fails otherwise
      return FactorisationStatus::singular;
    }
  };
  has_minimum_ =
      by_intervals_ && solved_or_failed(*by_intervals_, kkt_matrix_of(conditions_)) == FactorisationStatus::solved;
  if (has_minimum_) {
    measure_step(primal, memory.gradient_of_cost);
    has_minimum_ = step_.length <= settled || refine_step(kkt_matrix_of(conditions_));
  }
  if (by_intervals_ && !has_minimum_) {
    const Eigen::VectorXd diagonal =
        conditions_.diagonal.array() + rounding_of_curvature * largest_entry(program_, conditions_.hessian);
    const kkt::KktMatrix shifted{conditions_.hessian, conditions_.jacobian, diagonal, conditions_.compliance};
    has_minimum_ = solved_or_failed(*by_intervals_, shifted) == FactorisationStatus::solved && refine_step(shifted);
    if (has_minimum_) measure_step(primal, memory.gradient_of_cost);
    has_minimum_ = has_minimum_ && step_.length <= surely_settled;
  }
  if (!has_minimum_) {
    by_intervals_.reset();
    if (!pivoting_) pivoting_ = kkt_system_of_any_point(program_);
    if (solved_or_failed(*pivoting_, kkt_matrix_of(conditions_)) != FactorisationStatus::solved) return std::nullopt;
    has_minimum_ = pivoting_->has_minimum();
  }
  measure_step(primal, memory.gradient_of_cost);
  return std::isfinite(step_.length) ? std::optional(step_.length) : std::nullopt;
}

std::optional<NewtonCorrection> NewtonCorrections::at(const Eigen::VectorXd& primal,
                                                      const Eigen::VectorXd& multipliers) {
  KktMemory memory;
  evaluate_kkt(program_, primal, multipliers, memory);
  const std::optional<double> length = length_at(primal, multipliers, memory);
  if (!length) return std::nullopt;
  step_.length = *length;
  return step_;
}

/// Refines a step by eliminations of `eliminated`; false if it does not become the step of the matrix without a shift.
bool NewtonCorrections::refine_step(const kkt::KktMatrix& eliminated) {
  constexpr int most_refinements = 5;
  constexpr double accuracy = 1e-6;
  const kkt::KktMatrix matrix = kkt_matrix_of(conditions_);
  const kkt::KktStep step{step_.primal, step_.multipliers};
  if (!residual_) residual_ = std::make_unique<kkt::NewtonResidual>(program_);
  NewtonCorrection correction{.primal = step_.primal, .multipliers = step_.multipliers};
  for (int i = 0; i <= most_refinements; ++i) {
    residual_->compute(matrix, {conditions_.gradient, conditions_.constraints}, step);
    if (residual_->excess(matrix, step, accuracy) <= 1.0) return true;
    const FactorisationStatus status =
        by_intervals_->solve(eliminated, residual_->value(), {correction.primal, correction.multipliers});
    if (status != FactorisationStatus::solved) return false;
    step_.primal += correction.primal;
    step_.multipliers += correction.multipliers;
  }
  return false;
}

void NewtonCorrections::measure_step(const Eigen::VectorXd& primal, const Eigen::VectorXd& gradient) {
  const double least = smallest_share * std::max(1.0, largest(primal));
  const auto share = [&](Eigen::Index first, Eigen::Index count) {
    const double moves = step_.primal.segment(first, count).lpNorm<Eigen::Infinity>();
    return moves > 0.0 ? moves / std::max(primal.segment(first, count).lpNorm<Eigen::Infinity>(), least) : 0.0;
  };
  double of_state = std::abs(gradient.dot(step_.primal)) / std::max(1.0, std::abs(program_.objective(primal)));
  double of_controls = 0.0;
  if (const IntervalStructure* structure = program_.interval_structure()) {
    for (const PlaceRun& run : structure->unknowns.runs()) {
      double& length = run.is_control ? of_controls : of_state;
      length = std::max(length, share(static_cast<Eigen::Index>(run.first), static_cast<Eigen::Index>(run.count)));
    }
  } else if (primal.size() > 0) {
    of_state = std::max(of_state, share(0, primal.size()));
  }
  step_.length_of_state = of_state;
  step_.length = std::max(of_state, of_controls);
}

}  // namespace dmocbench
