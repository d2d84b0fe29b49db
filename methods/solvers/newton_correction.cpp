#include "methods/solvers/newton_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "methods/runtime/long_vectors.hpp"
#include "methods/solvers/kkt/intervals/interval_kkt.hpp"
#include "methods/solvers/kkt/sparse_kkt.hpp"

namespace dmocbench {

namespace {

using kkt::FactorisationStatus;
using kkt::IntervalKkt;
using kkt::KktSystem;
using kkt::SparseKkt;

/// The least distance to a bound by which a multiplier is divided.
constexpr double at_bound = 1e-10;
/// The compliance of an inequality that nothing holds: it takes no part.
constexpr double no_part = 1e10;

/// The distance from x to the bound that a gradient of this sign presses it against.
double distance_to_bound(double gradient, double x, double lower, double upper) {
  return gradient > 0.0 ? x - lower : upper - x;
}

/// The step is wanted at a point where rounding of the multipliers hides that it is a minimum, too.
std::unique_ptr<KktSystem> any_point(const NonlinearProgram& program) {
  return std::make_unique<SparseKkt>(program, SparseKkt::Order::found, SparseKkt::Inertia::any);
}

/// By intervals where the structure allows it, since that takes time linear in their number.
std::unique_ptr<KktSystem> make_system(const NonlinearProgram& program) {
  if (auto by_intervals = IntervalKkt::make(program)) return std::move(*by_intervals);
  return any_point(program);
}

double largest(const Eigen::VectorXd& x) { return x.size() > 0 ? x.lpNorm<Eigen::Infinity>() : 0.0; }

}  // namespace

/// The linearised conditions at a point.
struct NewtonCorrections::Linearised {
  Eigen::VectorXd hessian;
  Eigen::VectorXd diagonal;
  Eigen::VectorXd compliance;
  Eigen::VectorXd gradient;     // of the Lagrangian
  Eigen::VectorXd constraints;  // residuals

  void compute(NonlinearProgram& program, const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers,
               const KktMemory& memory) {
    hessian.resize(static_cast<Eigen::Index>(program.hessian_structure().size()));
    program.hessian(x, 1.0, multipliers, hessian);
    diagonal.setZero(x.size());
    compliance.setZero(multipliers.size());
    constraints = memory.constraints;
    gradient = memory.gradient;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const double distance =
          distance_to_bound(gradient[j], x[j], program.variable_lower()[j], program.variable_upper()[j]);
      if (!std::isfinite(distance)) continue;
      const double counted = std::max(distance, at_bound);
      diagonal[j] = std::abs(gradient[j]) / counted;
      gradient[j] *= distance / counted;
    }
    for (Eigen::Index i = 0; i < constraints.size(); ++i) {
      linearise_constraint(i, multipliers[i], program.constraint_lower()[i], program.constraint_upper()[i]);
    }
  }

 private:
  void linearise_constraint(Eigen::Index i, double multiplier, double lower, double upper) {
    const double value = constraints[i];
    constraints[i] = value - (multiplier < 0.0 ? lower : upper);
    if (lower == upper) return;
    const double distance = std::max(distance_to_bound(-multiplier, value, lower, upper), at_bound);
    compliance[i] = std::min(distance / std::abs(multiplier), no_part);
    if (!(compliance[i] < no_part)) compliance[i] = no_part;  // also where the multiplier is 0
    if (compliance[i] == no_part) constraints[i] = 0.0;
  }
};

NewtonCorrections::NewtonCorrections(NonlinearProgram& program, Factorisation factorisation)
    : program_(program),
      system_(factorisation == Factorisation::sparse ? any_point(program) : make_system(program)),
      linearised_(std::make_unique<Linearised>()) {}
NewtonCorrections::~NewtonCorrections() = default;

std::optional<double> NewtonCorrections::length_at(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers,
                                                   const KktMemory& memory) {
  Linearised& at = *linearised_;
  at.compute(program_, primal, multipliers, memory);
  step_.primal.setZero(primal.size());
  step_.multipliers.setZero(multipliers.size());
  if (!is_finite(at.hessian) || !is_finite(memory.jacobian) || !is_finite(at.gradient)) return unbounded;
  const auto solve = [&] {
    system_->begin_solve();
    return system_->solve({at.hessian, memory.jacobian, at.diagonal, at.compliance}, {at.gradient, at.constraints},
                          {step_.primal, step_.multipliers});
  };
  FactorisationStatus status = solve();
  if (status != FactorisationStatus::solved && dynamic_cast<SparseKkt*>(system_.get()) == nullptr) {
    system_ = any_point(program_);
    status = solve();
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
