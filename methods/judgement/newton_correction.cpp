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
using kkt::KktSystem;
using kkt::SparseKkt;

double largest(const Eigen::VectorXd& x) { return x.size() > 0 ? x.lpNorm<Eigen::Infinity>() : 0.0; }

}  // namespace

NewtonCorrections::NewtonCorrections(NonlinearProgram& program, Factorisation factorisation)
    : program_(program),
      system_(factorisation == Factorisation::sparse ? kkt_system_of_any_point(program) : kkt_system_of(program)) {}
NewtonCorrections::~NewtonCorrections() = default;

std::optional<double> NewtonCorrections::length_at(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers,
                                                   const KktMemory& memory) {
  conditions_.compute(program_, primal, multipliers, memory);
  step_.primal.setZero(primal.size());
  step_.multipliers.setZero(multipliers.size());
  if (!conditions_.is_finite()) return unbounded;
  const auto solve = [&] {
    system_->begin_solve();
    return system_->solve(kkt_matrix_of(conditions_), {conditions_.gradient, conditions_.constraints},
                          {step_.primal, step_.multipliers});
  };
  const auto solved_or_failed = [&] {
    try {
      return solve();
    } catch (const Stopped&) {
      throw;
    } catch (const std::exception&) {  // the factorisation is out of memory, or fails otherwise
      return FactorisationStatus::singular;
    }
  };
  FactorisationStatus status = solved_or_failed();
  if (status != FactorisationStatus::solved && dynamic_cast<SparseKkt*>(system_.get()) == nullptr) {
    system_ = kkt_system_of_any_point(program_);
    status = solved_or_failed();
  }
  if (status != FactorisationStatus::solved) return std::nullopt;
  const double length = length_of(primal, step_.primal, memory.gradient_of_cost);
  return std::isfinite(length) ? std::optional(length) : std::nullopt;
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

double NewtonCorrections::length_of(const Eigen::VectorXd& primal, const Eigen::VectorXd& step,
                                    const Eigen::VectorXd& gradient) {
  const double least = smallest_share * std::max(1.0, largest(primal));
  const auto share = [&](const auto& of_step, const auto& of_point) {
    const double moves = of_step.template lpNorm<Eigen::Infinity>();
    return moves > 0.0 ? moves / std::max(of_point.template lpNorm<Eigen::Infinity>(), least) : 0.0;
  };
  double length = 0.0;
  if (const IntervalStructure* structure = program_.interval_structure()) {
    for (const PlaceRun& run : structure->unknowns.runs()) {
      const auto first = static_cast<Eigen::Index>(run.first);
      const auto count = static_cast<Eigen::Index>(run.count);
      length = std::max(length, share(step.segment(first, count), primal.segment(first, count)));
    }
  } else if (primal.size() > 0) {
    length = share(step, primal);
  }
  const double cost = program_.objective(primal);
  return std::max(length, std::abs(gradient.dot(step)) / std::max(1.0, std::abs(cost)));
}

}  // namespace dmocbench
