#include "methods/judgement/negative_curvature.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <random>

#include "methods/kkt/sparse_kkt.hpp"
#include "methods/program/interval_structure.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

namespace {

/// The largest entry of H for every run of unknowns, one entry per unknown, of which none is taken below `least`.
Eigen::VectorXd largest_entries_of_runs(const NonlinearProgram& program, const Eigen::VectorXd& hessian, double least) {
  Eigen::VectorXd sizes = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(program.variable_count()), least);
  program.hessian_structure().for_each([&](Eigen::Index e, int i, int j) {
    if (is_fixed(program, i) || is_fixed(program, j)) return;
    for (const int unknown : {i, j}) sizes[unknown] = std::max(sizes[unknown], std::abs(hessian[e]));
  });
  for (const PlaceRun& run : program.interval_structure()->unknowns.runs()) {
    auto of_run = sizes.segment(static_cast<Eigen::Index>(run.first), static_cast<Eigen::Index>(run.count));
    if (run.count > 0) of_run.setConstant(of_run.maxCoeff());
  }
  return sizes;
}

/// The linearised conditions with a multiple of the diagonal matrix W added to H + Σ, all of it divided by the largest
/// entry of W: next to the Jacobian it may be as large as the scale of the cost.
class ShiftedSystem {
 public:
  ShiftedSystem(const NonlinearProgram& program, const LinearisedConditions& at, const Eigen::VectorXd& sizes)
      : size_(sizes.maxCoeff()),
        weights_(sizes / size_),
        jacobian_(at.jacobian),
        hessian_(at.hessian / size_),
        diagonal_(at.diagonal / size_),
        compliance_(at.compliance * size_),
        program_(program),
        no_residuals_(Eigen::VectorXd::Zero(at.constraints.size())),
        multipliers_(no_residuals_) {}

  /// True where elimination by intervals shows that this shift is enough: its test of the inertia is sufficient.
  [[nodiscard]] bool shows_minimum(double shift) {
    const auto by_intervals = kkt_system_by_intervals(program_);
    Eigen::VectorXd step = weights_;
    return by_intervals && solve_by(*by_intervals, shift, weights_, step) == kkt::FactorisationStatus::solved;
  }

  /// Solves for a right-hand side in the place of the gradient.
  [[nodiscard]] kkt::FactorisationStatus solve(double shift, const Eigen::VectorXd& right_hand_side,
                                               Eigen::VectorXd& solution) {
    if (!kkt_) kkt_.emplace(program_, kkt::SparseKkt::Order::found, kkt::SparseKkt::Inertia::minimum);
    return solve_by(*kkt_, shift, right_hand_side, solution);
  }

  /// The largest entry of W.
  [[nodiscard]] double size() const noexcept { return size_; }
  /// The diagonal of W, its largest entry 1.
  [[nodiscard]] const Eigen::VectorXd& weights() const noexcept { return weights_; }

 private:
  [[nodiscard]] kkt::FactorisationStatus solve_by(kkt::KktSystem& kkt, double shift,
                                                  const Eigen::VectorXd& right_hand_side, Eigen::VectorXd& solution) {
    const Eigen::VectorXd diagonal = diagonal_ + shift * weights_;
    const Eigen::VectorXd gradient = -right_hand_side;
    try {
      return kkt.solve({hessian_, jacobian_, diagonal, compliance_}, {gradient, no_residuals_},
                       {solution, multipliers_});
    } catch (const Stopped&) {
      throw;
    } catch (const std::exception&) {  // out of memory, or another failure of the factorisation
      return kkt::FactorisationStatus::singular;
    }
  }

  double size_;
  Eigen::VectorXd weights_;
  const Eigen::VectorXd& jacobian_;
  Eigen::VectorXd hessian_;
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd compliance_;
  const NonlinearProgram& program_;
  std::optional<kkt::SparseKkt> kkt_;  // made when it is first needed
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

/// The direction of the most negative curvature next to W.
std::optional<NegativeCurvature> negative_curvature_next_to(ShiftedSystem& system) {
  using kkt::FactorisationStatus;
  constexpr double growth = 4.0;   // from shift to shift
  constexpr int most_shifts = 16;  // up to a hundred times the largest entry
  constexpr int bisections = 5;    // until the shift is so near the curvature that inverse iteration converges at once
  constexpr int most_steps = 20;
  constexpr double enough = 1e-2;  // relative change of the curvature at which its direction is known

  const Eigen::VectorXd& weights = system.weights();
  Eigen::VectorXd image(weights.size());
  Eigen::VectorXd vector = any_vector(image.size());
  double too_small = negligible_curvature;
  if (system.shows_minimum(too_small)) return std::nullopt;
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
  // Inverse iteration: with b = Wd / √(dᵀWd) and (H + Σ + σW) d' = b in the null space, the curvature along d' is
  // bᵀd' / d'ᵀWd' - σ, which falls towards the smallest eigenvalue.
  double curvature = unbounded;
  for (int steps = 0; steps < most_steps && status == FactorisationStatus::solved && !image.isZero(0.0); ++steps) {
    const double before = curvature;
    const double square = image.dot(weights.cwiseProduct(image));
    curvature = vector.dot(image) / square - shift;
    vector = weights.cwiseProduct(image) / std::sqrt(square);
    if (curvature < 0.0 && std::abs(before - curvature) <= enough * std::abs(curvature)) break;
    status = system.solve(shift, vector, image);
  }
  if (!(curvature < -negligible_curvature)) return std::nullopt;
  const Eigen::VectorXd direction = vector.cwiseQuotient(weights);
  const double largest = direction.lpNorm<Eigen::Infinity>();
  return NegativeCurvature{
      .direction = direction / largest, .value = curvature * system.size() / (largest * largest), .share = curvature};
}

}  // namespace

std::optional<NegativeCurvature> negative_curvature(const NonlinearProgram& program, const LinearisedConditions& at) {
  constexpr double alike = 1e-3;   // ratio of the sizes of runs above which one size serves for all
  constexpr double least = 1e-10;  // ratio of sizes below which entries of H are round-off
  const double size = largest_entry(program, at.hessian);
  if (!(size > 0.0) || !std::isfinite(size)) return std::nullopt;
  ShiftedSystem of_all(program, at, Eigen::VectorXd::Constant(at.gradient.size(), size));
  std::optional<NegativeCurvature> found = negative_curvature_next_to(of_all);
  if (found || program.interval_structure() == nullptr) return found;
  const Eigen::VectorXd sizes = largest_entries_of_runs(program, at.hessian, least * size);
  if (sizes.minCoeff() > alike * size) return std::nullopt;
  ShiftedSystem of_runs(program, at, sizes);
  return negative_curvature_next_to(of_runs);
}

}  // namespace dmocbench
