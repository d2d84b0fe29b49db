// Compiled once per instruction set, see kernels.hpp.
// q = (r, φ), L = ½(V² + R²W²) + 1/R, f = (0, R u), C = u²
#include <cstddef>

#include "bench/speed/kernels.hpp"
#include "methods/runtime/independent_iterations.hpp"

namespace dmocbench::speed {

namespace {

void residual(std::size_t intervals, const HandSeries& columns) {
  const auto [r_left, phi_left, r_right, phi_right, u, step] = first<6>(columns.in);
  const auto out = first<4>(columns.out);
  DMOCBENCH_INDEPENDENT_ITERATIONS
  for (std::size_t k = 0; k < intervals; ++k) {
    const double h = step[k];
    const double rate = 1.0 / h;
    const double R = 0.5 * (r_left[k] + r_right[k]);
    const double V = (r_right[k] - r_left[k]) * rate;
    const double W = (phi_right[k] - phi_left[k]) * rate;
    const double force_r = 0.5 * h * (R * W * W - 1.0 / (R * R));
    const double force_phi = 0.5 * h * R * u[k];
    const double momentum = R * R * W;
    store(out, k, {force_r - V, force_phi - momentum, force_r + V, force_phi + momentum});
  }
}

void jacobian(std::size_t intervals, const HandSeries& columns) {
  const auto [r_left, phi_left, r_right, phi_right, u, step] = first<6>(columns.in);
  const auto out = first<18>(columns.out);
  DMOCBENCH_INDEPENDENT_ITERATIONS
  for (std::size_t k = 0; k < intervals; ++k) {
    const double h = step[k];
    const double rate = 1.0 / h;
    const double R = 0.5 * (r_left[k] + r_right[k]);
    const double W = (phi_right[k] - phi_left[k]) * rate;
    const double inverse = 1.0 / R;
    const double force_r = 0.25 * h * (W * W + 2.0 * inverse * inverse * inverse);  // ½ ∂(h/2 G_r)/∂R
    const double force_phi = R * W;                                                 // 1/h ∂(h/2 G_r)/∂W
    const double turn = 0.25 * h * u[k];                                            // ½ ∂(h/2 R u)/∂R
    const double by_r = R * W;                                                      // ½ ∂(R²W)/∂R
    const double by_phi = R * R * rate;                                             // 1/h ∂(R²W)/∂W
    const double by_u = 0.5 * h * R;
    store(out, k,
          {// Left constraint of r, by r_left, φ_left, r_right, φ_right.
           force_r + rate, -force_phi, force_r - rate, force_phi,
           // Left constraint of φ, and by u.
           turn - by_r, by_phi, turn - by_r, -by_phi, by_u,
           // Right constraint of r.
           force_r - rate, -force_phi, force_r + rate, force_phi,
           // Right constraint of φ, and by u.
           turn + by_r, -by_phi, turn + by_r, by_phi, by_u});
  }
}

void hessian(std::size_t intervals, const HandSeries& columns) {
  const auto [r_left, phi_left, r_right, phi_right, u, step, time, cost_factor, lambda_left_r, lambda_left_phi,
              lambda_right_r, lambda_right_phi] = first<12>(columns.in);
  const double factor = columns.factor;
  const auto out = first<13>(columns.out);
  DMOCBENCH_INDEPENDENT_ITERATIONS
  for (std::size_t k = 0; k < intervals; ++k) {
    const double h = step[k];
    const double rate = 1.0 / h;
    const double R = 0.5 * (r_left[k] + r_right[k]);
    const double W = (phi_right[k] - phi_left[k]) * rate;
    const double inverse = 1.0 / R;
    const double inverse_2 = inverse * inverse;
    const double alpha = 0.5 * h * (lambda_left_r[k] + lambda_right_r[k]);
    const double delta = lambda_right_phi[k] - lambda_left_phi[k];
    const double by_r_r = 0.5 * (delta * W - 3.0 * alpha * inverse_2 * inverse_2);  // ¼ ℓ_RR
    const double by_r_phi = (alpha * W + delta * R) * rate;                         // ½ ℓ_RW / h
    const double by_phi_phi = 2.0 * alpha * R * rate * rate;                        // ℓ_WW / h²
    const double by_r_u = 0.25 * h * (lambda_left_phi[k] + lambda_right_phi[k]);    // ½ ℓ_Ru
    store(out, k,
          {by_r_r, -by_r_phi, by_phi_phi, by_r_r, -by_r_phi, by_r_r, by_r_phi, -by_phi_phi, by_r_phi, by_phi_phi,
           by_r_u, by_r_u, 2.0 * factor * h});
  }
}

}  // namespace

namespace DMOCBENCH_KERNELS {

HandFunctions orbital_transfer() { return {residual, jacobian, hessian}; }

}  // namespace DMOCBENCH_KERNELS

}  // namespace dmocbench::speed
