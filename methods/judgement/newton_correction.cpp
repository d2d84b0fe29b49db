#include "methods/judgement/newton_correction.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include "methods/judgement/linearised_conditions.hpp"
#include "methods/kkt/sparse_kkt.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

namespace {

using kkt::FactorisationStatus;

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
  const auto solved_or_failed = [&](kkt::KktSystem& system) {
    try {
      system.begin_solve();
      return system.solve(kkt_matrix_of(conditions_), {conditions_.gradient, conditions_.constraints},
                          {step_.primal, step_.multipliers});
    } catch (const Stopped&) {
      throw;
    } catch (const std::exception&) {  // the factorisation is out of memory, or fails otherwise
      return FactorisationStatus::singular;
    }
  };
  FactorisationStatus status = FactorisationStatus::untrusted;
  if (by_intervals_) status = solved_or_failed(*by_intervals_);
  has_minimum_ = status == FactorisationStatus::solved;
  if (!has_minimum_) {
    by_intervals_.reset();
    if (!pivoting_) pivoting_ = kkt_system_of_any_point(program_);
    status = solved_or_failed(*pivoting_);
    has_minimum_ = status == FactorisationStatus::solved && pivoting_->has_minimum();
  }
  if (status != FactorisationStatus::solved) return std::nullopt;
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
