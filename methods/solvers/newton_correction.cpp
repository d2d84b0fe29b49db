#include "methods/solvers/newton_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "methods/solvers/kkt/sparse_kkt.hpp"
#include "methods/solvers/kkt_of_conditions.hpp"

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

std::optional<NewtonCorrection> NewtonCorrections::at(const Eigen::VectorXd& primal,
                                                      const Eigen::VectorXd& multipliers) {
  const LinearisedConditions at(program_, primal, multipliers);
  NewtonCorrection correction{.primal = Eigen::VectorXd::Zero(primal.size()),
                              .multipliers = Eigen::VectorXd::Zero(multipliers.size())};
  if (!at.is_finite()) {
    correction.length = unbounded;
    return correction;
  }
  const auto solve = [&] {
    return system_->solve(kkt_matrix_of(at), {at.gradient, at.constraints},
                          {correction.primal, correction.multipliers});
  };
  FactorisationStatus status = solve();
  if (status != FactorisationStatus::solved && dynamic_cast<SparseKkt*>(system_.get()) == nullptr) {
    system_ = kkt_system_of_any_point(program_);
    status = solve();
  }
  if (status != FactorisationStatus::solved) return std::nullopt;
  correction.length = length_of(primal, correction.primal, at.gradient_of_cost);
  if (!std::isfinite(correction.length)) return std::nullopt;
  return correction;
}

double NewtonCorrections::length_of(const Eigen::VectorXd& primal, const Eigen::VectorXd& step,
                                    const Eigen::VectorXd& gradient) {
  const double least = smallest_share * largest(primal);
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
