// Compiled once per instruction set, see kernels.hpp.
// q = (θ₁, θ₂), D = θ₁ - θ₂, L = ½ a ω₁² + ½ b ω₂² + c cos D ω₁ω₂ - g₁ sin θ₁ - g₂ sin θ₂, f = (τ₁ - τ₂, τ₂),
// C = ½(τ₁² + τ₂²)
#include <algorithm>
#include <array>
#include <cstddef>

#include <xsimd/xsimd.hpp>

#include "bench/speed/kernels.hpp"
#include "methods/runtime/independent_iterations.hpp"

namespace dmocbench::speed {

namespace {

using Vector = xsimd::batch<double>;

constexpr double a = 4.0 / 3.0;  // (m₁ + 4m₂)l₁²/4 + J₁
constexpr double b = 1.0 / 3.0;  // m₂l₂²/4 + J₂
constexpr double c = 0.5;        // m₂l₁l₂/2
constexpr double g1 = 1.5 * 9.81;
constexpr double g2 = 0.5 * 9.81;

/// The middle of an interval.
struct Middle {
  double h, rate;                 // step and 1 / h
  double w1, w2;                  // ω₁, ω₂
  double S, K;                    // c sin D, c cos D
  double function_1, function_2;  // cos θ₁, cos θ₂ or sin θ₁, sin θ₂
};

/// Carries out `formulas(k, middle)` for every interval k, `function` being cosine or sine.
///
/// g++ calls no vector sine by itself without -ffast-math, so sines and cosines come from the tape's own library, for
/// as many intervals at a time as fit into the first-level cache; everything else is plain loops.
template <class Function, class Formulas>
[[gnu::always_inline]] inline void for_each_interval(std::size_t intervals, const HandSeries& columns,
                                                     const Function& function, const Formulas& formulas) {
  constexpr std::size_t width = 64;
  alignas(64) std::array<double, width> theta_1{};
  alignas(64) std::array<double, width> theta_2{};
  alignas(64) std::array<double, width> difference{};
  alignas(64) std::array<double, width> sine{};
  alignas(64) std::array<double, width> cosine{};
  alignas(64) std::array<double, width> function_1{};
  alignas(64) std::array<double, width> function_2{};
  const auto [left_1, left_2, right_1, right_2, tau_1, tau_2, step] = first<7>(columns.in);
  for (std::size_t begin = 0; begin < intervals; begin += width) {
    const std::size_t count = std::min(width, intervals - begin);
    DMOCBENCH_INDEPENDENT_ITERATIONS
    for (std::size_t i = 0; i < count; ++i) {
      theta_1[i] = 0.5 * (left_1[begin + i] + right_1[begin + i]);
      theta_2[i] = 0.5 * (left_2[begin + i] + right_2[begin + i]);
      difference[i] = theta_1[i] - theta_2[i];
    }
    for (std::size_t i = 0; i < width; i += Vector::size) {
      const auto [sine_of_D, cosine_of_D] = xsimd::sincos(Vector::load_aligned(&difference[i]));
      sine_of_D.store_aligned(&sine[i]);
      cosine_of_D.store_aligned(&cosine[i]);
      function(Vector::load_aligned(&theta_1[i])).store_aligned(&function_1[i]);
      function(Vector::load_aligned(&theta_2[i])).store_aligned(&function_2[i]);
    }
    DMOCBENCH_INDEPENDENT_ITERATIONS
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = begin + i;
      const double rate = 1.0 / step[k];
      formulas(k, Middle{step[k], rate, (right_1[k] - left_1[k]) * rate, (right_2[k] - left_2[k]) * rate, c * sine[i],
                         c * cosine[i], function_1[i], function_2[i]});
    }
  }
}

constexpr auto cosine_of = [](const Vector& angle) { return xsimd::cos(angle); };
constexpr auto sine_of = [](const Vector& angle) { return xsimd::sin(angle); };

void residual(std::size_t intervals, const HandSeries& columns) {
  const auto [left_1, left_2, right_1, right_2, tau_1, tau_2] = first<6>(columns.in);
  const auto out = first<4>(columns.out);
  const auto formulas = [=](std::size_t k, const Middle& middle) __attribute__((always_inline)) {
    const auto [h, rate, w1, w2, S, K, cosine_1, cosine_2] = middle;
    const double centrifugal = S * w1 * w2;
    const double force_1 = 0.5 * h * (tau_1[k] - tau_2[k] - centrifugal - g1 * cosine_1);
    const double force_2 = 0.5 * h * (tau_2[k] + centrifugal - g2 * cosine_2);
    const double momentum_1 = a * w1 + K * w2;
    const double momentum_2 = b * w2 + K * w1;
    store(out, k, {force_1 - momentum_1, force_2 - momentum_2, force_1 + momentum_1, force_2 + momentum_2});
  };
  for_each_interval(intervals, columns, cosine_of, formulas);
}

void jacobian(std::size_t intervals, const HandSeries& columns) {
  const auto out = first<22>(columns.out);
  const auto formulas = [=](std::size_t k, const Middle& middle) __attribute__((always_inline)) {
    const auto [h, rate, w1, w2, S, K, sine_1, sine_2] = middle;
    const double s1 = 0.5 * S * w1;
    const double s2 = 0.5 * S * w2;
    const double both = 0.25 * h * K * w1 * w2;  // ½ ∂(h/2 G₁)/∂θ₂ = ½ ∂(h/2 G₂)/∂θ₁
    const double own_1 = 0.25 * h * g1 * sine_1 - both;
    const double own_2 = 0.25 * h * g2 * sine_2 - both;
    const double half = 0.5 * h;
    store(out, k,
          {// Left constraint of θ₁, by θ₁ and θ₂ on the left, on the right, and by τ₁, τ₂.
           own_1 + 2.0 * s2 + rate * a, both + s1 - s2 + rate * K, own_1 - rate * a, both - s1 - s2 - rate * K, half,
           -half,
           // Left constraint of θ₂, without τ₁.
           both + s1 - s2 + rate * K, own_2 - 2.0 * s1 + rate * b, both + s1 + s2 - rate * K, own_2 - rate * b, half,
           // Right constraint of θ₁.
           own_1 - rate * a, both + s1 + s2 - rate * K, own_1 - 2.0 * s2 + rate * a, both - s1 + s2 + rate * K, half,
           -half,
           // Right constraint of θ₂.
           both - s1 - s2 - rate * K, own_2 - rate * b, both - s1 + s2 + rate * K, own_2 + 2.0 * s1 + rate * b, half});
  };
  for_each_interval(intervals, columns, sine_of, formulas);
}

void hessian(std::size_t intervals, const HandSeries& columns) {
  const auto [left_1, left_2, right_1, right_2, tau_1, tau_2, step, time, cost_factor, lambda_left_1, lambda_left_2,
              lambda_right_1, lambda_right_2] = first<13>(columns.in);
  const auto out = first<12>(columns.out);
  const double factor = columns.factor;
  const auto formulas = [=](std::size_t k, const Middle& middle) __attribute__((always_inline)) {
    const auto [h, rate, w1, w2, S, K, cosine_1, cosine_2] = middle;
    const double alpha_1 = 0.5 * h * (lambda_left_1[k] + lambda_right_1[k]);
    const double alpha_2 = 0.5 * h * (lambda_left_2[k] + lambda_right_2[k]);
    const double delta_1 = lambda_right_1[k] - lambda_left_1[k];
    const double delta_2 = lambda_right_2[k] - lambda_left_2[k];
    const double turn = alpha_2 - alpha_1;
    const double by_D_D = -0.25 * (turn * S * w1 * w2 + K * (delta_1 * w2 + delta_2 * w1));  // ¼ ℓ_DD
    const double own_1 = by_D_D + 0.25 * alpha_1 * g1 * cosine_1;                            // ¼ ℓ by θ₁ twice
    const double own_2 = by_D_D + 0.25 * alpha_2 * g2 * cosine_2;
    const double by_D_w1 = 0.5 * rate * (turn * K * w2 - S * delta_2);  // ½ ℓ_Dω₁ / h
    const double by_D_w2 = 0.5 * rate * (turn * K * w1 - S * delta_1);
    const double by_w1_w2 = turn * S * rate * rate;  // ℓ_ω₁ω₂ / h²
    store(out, k,
          {// Rows and columns: θ₁, θ₂ on the left, θ₁, θ₂ on the right, τ₁, τ₂.
           own_1 - 2.0 * by_D_w1, by_D_w1 - by_D_w2 - by_D_D + by_w1_w2, own_2 + 2.0 * by_D_w2, own_1,
           -by_D_w1 - by_D_w2 - by_D_D - by_w1_w2, own_1 + 2.0 * by_D_w1, by_D_w1 + by_D_w2 - by_D_D - by_w1_w2, own_2,
           by_D_w2 - by_D_w1 - by_D_D + by_w1_w2, own_2 - 2.0 * by_D_w2, factor * h, factor * h});
  };
  for_each_interval(intervals, columns, cosine_of, formulas);
}

}  // namespace

namespace DMOCBENCH_KERNELS {

HandFunctions two_link_manipulator() { return {residual, jacobian, hessian}; }

}  // namespace DMOCBENCH_KERNELS

}  // namespace dmocbench::speed
