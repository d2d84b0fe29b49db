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

/// The linearised conditions with a multiple of the unit matrix added to H + Σ.
class ShiftedSystem {
 public:
  ShiftedSystem(const NonlinearProgram& program, const LinearisedConditions& at)
      : at_(at),
        kkt_(program, kkt::SparseKkt::Order::found, kkt::SparseKkt::Inertia::minimum),
        no_residuals_(Eigen::VectorXd::Zero(at.constraints.size())),
        multipliers_(no_residuals_) {}

  /// Solves for a right-hand side in the place of the gradient.
  [[nodiscard]] kkt::FactorisationStatus solve(double shift, const Eigen::VectorXd& right_hand_side,
                                               Eigen::VectorXd& solution) {
    const Eigen::VectorXd diagonal = at_.diagonal.array() + shift;
    const Eigen::VectorXd gradient = -right_hand_side;
    try {
      return kkt_.solve({at_.hessian, at_.jacobian, diagonal, at_.compliance}, {gradient, no_residuals_},
                        {solution, multipliers_});
    } catch (const Stopped&) {
      throw;
    } catch (const std::exception&) {  // out of memory, or another failure of the factorisation
      return kkt::FactorisationStatus::singular;
    }
  }

 private:
  const LinearisedConditions& at_;
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
  constexpr double growth = 4.0;   // from shift to shift: the one that suffices is at most so far above the curvature
  constexpr int most_shifts = 16;  // up to a hundred times the largest entry
  constexpr int most_steps = 20;
  constexpr double enough = 1e-2;  // relative change of the curvature at which its direction is known
  const double size = largest_entry(program, at.hessian);
  if (!(size > 0.0) || !std::isfinite(size)) return std::nullopt;

  ShiftedSystem system(program, at);
  Eigen::VectorXd image(at.gradient.size());
  Eigen::VectorXd vector = any_vector(image.size());
  double shift = negligible_curvature * size;
  FactorisationStatus status = system.solve(shift, vector, image);
  if (status != FactorisationStatus::wrong_inertia) return std::nullopt;
  for (int shifts = 0; shifts < most_shifts && status == FactorisationStatus::wrong_inertia; ++shifts) {
    shift *= growth;
    status = system.solve(shift, vector, image);
  }
  // Inverse iteration: with b = d / |d| and (H + Σ + σ) d' = b in the null space, the curvature along d' is
  // bᵀd' / d'ᵀd' - σ, which falls towards the smallest eigenvalue.
  double curvature = unbounded;
  for (int steps = 0; steps < most_steps && status == FactorisationStatus::solved && !image.isZero(0.0); ++steps) {
    const double before = curvature;
    curvature = vector.dot(image) / image.squaredNorm() - shift;
    vector = image / image.norm();
    if (steps > 0 && std::abs(before - curvature) <= enough * std::abs(curvature)) break;
    status = system.solve(shift, vector, image);
  }
  if (!(curvature < -negligible_curvature * size)) return std::nullopt;
  return NegativeCurvature{.direction = vector / vector.lpNorm<Eigen::Infinity>(), .share = curvature / size};
}

}  // namespace dmocbench
