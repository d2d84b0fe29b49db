#include "methods/judgement/negative_curvature.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <random>

#include "methods/kkt/sparse_kkt.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

namespace {

/// The largest entry of H between variables that may move.
double largest_entry(const NonlinearProgram& program, const Eigen::VectorXd& hessian) {
  double largest = 0.0;
  program.hessian_structure().for_each([&](Eigen::Index e, int i, int j) {
    if (!is_fixed(program, i) && !is_fixed(program, j)) largest = std::max(largest, std::abs(hessian[e]));
  });
  return largest;
}

/// The linearised conditions with a multiple of the unit matrix added to H + Σ, all of it divided by the largest entry
/// of H: next to the Jacobian it may be as large as the scale of the cost.
class ShiftedSystem {
 public:
  ShiftedSystem(const NonlinearProgram& program, const LinearisedConditions& at, double size)
      : jacobian_(at.jacobian),
        hessian_(at.hessian / size),
        diagonal_(at.diagonal / size),
        compliance_(at.compliance * size),
        kkt_(program, kkt::SparseKkt::Order::found, kkt::SparseKkt::Inertia::minimum),
        no_residuals_(Eigen::VectorXd::Zero(at.constraints.size())),
        multipliers_(no_residuals_) {}

  /// Solves for a right-hand side in the place of the gradient.
  [[nodiscard]] kkt::FactorisationStatus solve(double shift, const Eigen::VectorXd& right_hand_side,
                                               Eigen::VectorXd& solution) {
    const Eigen::VectorXd diagonal = diagonal_.array() + shift;
    const Eigen::VectorXd gradient = -right_hand_side;
    try {
      return kkt_.solve({hessian_, jacobian_, diagonal, compliance_}, {gradient, no_residuals_},
                        {solution, multipliers_});
    } catch (const Stopped&) {
      throw;
    } catch (const std::exception&) {  // out of memory, or another failure of the factorisation
      return kkt::FactorisationStatus::singular;
    }
  }

 private:
  const Eigen::VectorXd& jacobian_;
  Eigen::VectorXd hessian_;
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd compliance_;
  kkt::SparseKkt kkt_;
  Eigen::VectorXd no_residuals_;
  Eigen::VectorXd multipliers_;
};

/// A vector with a part in every direction, symmetric ones included; the same in every run.
Eigen::VectorXd any_vector(Eigen::Index size) {
  std::minstd_rand random;  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same in every run
  Eigen::VectorXd result(size);
  for (double& entry : result) entry = static_cast<double>(random()) / std::minstd_rand::max() - 0.5;
  return result;
}

}  // namespace

std::optional<NegativeCurvature> negative_curvature(const NonlinearProgram& program, const LinearisedConditions& at) {
  using kkt::FactorisationStatus;
  constexpr double growth = 4.0;   // from shift to shift
  constexpr int most_shifts = 16;  // up to a hundred times the largest entry
  constexpr int bisections = 5;    // until the shift is so near the curvature that inverse iteration converges at once
  constexpr int most_steps = 20;
  constexpr double enough = 1e-2;  // relative change of the curvature at which its direction is known
  const double size = largest_entry(program, at.hessian);
  if (!(size > 0.0) || !std::isfinite(size)) return std::nullopt;

  ShiftedSystem system(program, at, size);
  Eigen::VectorXd image(at.gradient.size());
  Eigen::VectorXd vector = any_vector(image.size());
  double too_small = negligible_curvature;
  if (system.solve(too_small, vector, image) != FactorisationStatus::wrong_inertia) return std::nullopt;
  double shift = growth * too_small;
  FactorisationStatus status = system.solve(shift, vector, image);
  for (int shifts = 1; shifts < most_shifts && status == FactorisationStatus::wrong_inertia; ++shifts) {
    too_small = shift;
    shift *= growth;
    status = system.solve(shift, vector, image);
  }
  for (int i = 0; i < bisections && status == FactorisationStatus::solved; ++i) {
    const double middle = std::sqrt(too_small * shift);
    const bool is_enough = system.solve(middle, vector, image) == FactorisationStatus::solved;
    (is_enough ? shift : too_small) = middle;
  }
  status = system.solve(shift, vector, image);
  // Inverse iteration: with b = d / |d| and (H + Σ + σ) d' = b in the null space, the curvature along d' is
  // bᵀd' / d'ᵀd' - σ, which falls towards the smallest eigenvalue.
  double curvature = unbounded;
  for (int steps = 0; steps < most_steps && status == FactorisationStatus::solved && !image.isZero(0.0); ++steps) {
    const double before = curvature;
    curvature = vector.dot(image) / image.squaredNorm() - shift;
    vector = image / image.norm();
    if (curvature < 0.0 && std::abs(before - curvature) <= enough * std::abs(curvature)) break;
    status = system.solve(shift, vector, image);
  }
  if (!(curvature < -negligible_curvature)) return std::nullopt;
  return NegativeCurvature{.direction = vector / vector.lpNorm<Eigen::Infinity>(), .share = curvature};
}

}  // namespace dmocbench
