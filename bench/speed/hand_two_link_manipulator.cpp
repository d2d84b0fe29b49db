// Compiled once per instruction set, see kernels.hpp.
// q = (θ₁, θ₂), D = θ₁ - θ₂, L = ½ a ω₁² + ½ b ω₂² + c cos D ω₁ω₂ - g₁ sin θ₁ - g₂ sin θ₂, f = (τ₁ - τ₂, τ₂),
// C = ½(τ₁² + τ₂²)
#include <algorithm>
#include <array>
#include <cstddef>

#include <xsimd/xsimd.hpp>

#include "bench/speed/kernels.hpp"

namespace dmocbench::speed {

namespace {

constexpr double a = 4.0 / 3.0;  // (m₁ + 4m₂)l₁²/4 + J₁
constexpr double b = 1.0 / 3.0;  // m₂l₂²/4 + J₂
constexpr double c = 0.5;        // m₂l₁l₂/2
constexpr double g1 = 1.5 * 9.81;
constexpr double g2 = 0.5 * 9.81;

/// Sines and cosines at the middle of some intervals, few enough to stay in the first-level cache. g++ calls no vector
/// sine by itself without -ffast-math, so they come from the tape's own library; everything else is plain loops.
class Angles {
 public:
  static constexpr std::size_t width = 64;
  using Column = std::array<double, width>;

  /// Of the intervals `begin` .. `begin` + `count` - 1.
  void find(std::size_t begin, std::size_t count, const HandColumns& columns) {
    const auto [left_1, left_2, right_1, right_2] = first<4>(columns.in);
#pragma GCC ivdep
    for (std::size_t k = 0; k < count; ++k) {
      theta_1_[k] = 0.5 * (left_1[begin + k] + right_1[begin + k]);
      theta_2_[k] = 0.5 * (left_2[begin + k] + right_2[begin + k]);
      difference_[k] = theta_1_[k] - theta_2_[k];
    }
    using Vector = xsimd::batch<double>;
    for (std::size_t k = 0; k < width; k += Vector::size) {
      const auto of_difference = xsimd::sincos(Vector::load_aligned(difference_.data() + k));
      of_difference.first.store_aligned(sine.data() + k);
      of_difference.second.store_aligned(cosine.data() + k);
      xsimd::cos(Vector::load_aligned(theta_1_.data() + k)).store_aligned(cosine_1.data() + k);
      xsimd::cos(Vector::load_aligned(theta_2_.data() + k)).store_aligned(cosine_2.data() + k);
    }
  }
  /// Those that only the Jacobian needs, of the same intervals.
  void find_sines() {
    using Vector = xsimd::batch<double>;
    for (std::size_t k = 0; k < width; k += Vector::size) {
      xsimd::sin(Vector::load_aligned(theta_1_.data() + k)).store_aligned(sine_1.data() + k);
      xsimd::sin(Vector::load_aligned(theta_2_.data() + k)).store_aligned(sine_2.data() + k);
    }
  }

  alignas(64) Column sine{};    // of D
  alignas(64) Column cosine{};  // of D
  alignas(64) Column sine_1{};
  alignas(64) Column cosine_1{};
  alignas(64) Column sine_2{};
  alignas(64) Column cosine_2{};

 private:
  alignas(64) Column theta_1_{};
  alignas(64) Column theta_2_{};
  alignas(64) Column difference_{};
};

void residual(std::size_t intervals, const HandColumns& columns) {
  const auto [left_1, left_2, right_1, right_2, tau_1, tau_2, step] = first<7>(columns.in);
  const auto out = first<4>(columns.out);
  Angles angles;
  for (std::size_t begin = 0; begin < intervals; begin += Angles::width) {
    const std::size_t count = std::min(Angles::width, intervals - begin);
    angles.find(begin, count, columns);
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = begin + i;
      const double h = step[k];
      const double rate = 1.0 / h;
      const double w1 = (right_1[k] - left_1[k]) * rate;
      const double w2 = (right_2[k] - left_2[k]) * rate;
      const double S = c * angles.sine[i];
      const double K = c * angles.cosine[i];
      const double centrifugal = S * w1 * w2;
      const double force_1 = 0.5 * h * (tau_1[k] - tau_2[k] - centrifugal - g1 * angles.cosine_1[i]);
      const double force_2 = 0.5 * h * (tau_2[k] + centrifugal - g2 * angles.cosine_2[i]);
      const double momentum_1 = a * w1 + K * w2;
      const double momentum_2 = b * w2 + K * w1;
      out[0][k] = force_1 - momentum_1;
      out[1][k] = force_2 - momentum_2;
      out[2][k] = force_1 + momentum_1;
      out[3][k] = force_2 + momentum_2;
    }
  }
}

void jacobian(std::size_t intervals, const HandColumns& columns) {
  const auto [left_1, left_2, right_1, right_2, tau_1, tau_2, step] = first<7>(columns.in);
  const auto out = first<22>(columns.out);
  Angles angles;
  for (std::size_t begin = 0; begin < intervals; begin += Angles::width) {
    const std::size_t count = std::min(Angles::width, intervals - begin);
    angles.find(begin, count, columns);
    angles.find_sines();
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = begin + i;
      const double h = step[k];
      const double rate = 1.0 / h;
      const double w1 = (right_1[k] - left_1[k]) * rate;
      const double w2 = (right_2[k] - left_2[k]) * rate;
      const double K = c * angles.cosine[i];
      const double s1 = 0.5 * c * angles.sine[i] * w1;
      const double s2 = 0.5 * c * angles.sine[i] * w2;
      const double both = 0.25 * h * K * w1 * w2;  // ½ ∂(h/2 G₁)/∂θ₂ = ½ ∂(h/2 G₂)/∂θ₁
      const double own_1 = 0.25 * h * g1 * angles.sine_1[i] - both;
      const double own_2 = 0.25 * h * g2 * angles.sine_2[i] - both;
      const double half = 0.5 * h;
      // Left constraint of θ₁, by θ₁ and θ₂ on the left, on the right, and by τ₁, τ₂.
      out[0][k] = own_1 + 2.0 * s2 + rate * a;
      out[1][k] = both + s1 - s2 + rate * K;
      out[2][k] = own_1 - rate * a;
      out[3][k] = both - s1 - s2 - rate * K;
      out[4][k] = half;
      out[5][k] = -half;
      // Left constraint of θ₂, without τ₁.
      out[6][k] = both + s1 - s2 + rate * K;
      out[7][k] = own_2 - 2.0 * s1 + rate * b;
      out[8][k] = both + s1 + s2 - rate * K;
      out[9][k] = own_2 - rate * b;
      out[10][k] = half;
      // Right constraint of θ₁.
      out[11][k] = own_1 - rate * a;
      out[12][k] = both + s1 + s2 - rate * K;
      out[13][k] = own_1 - 2.0 * s2 + rate * a;
      out[14][k] = both - s1 + s2 + rate * K;
      out[15][k] = half;
      out[16][k] = -half;
      // Right constraint of θ₂.
      out[17][k] = both - s1 - s2 - rate * K;
      out[18][k] = own_2 - rate * b;
      out[19][k] = both - s1 + s2 + rate * K;
      out[20][k] = own_2 + 2.0 * s1 + rate * b;
      out[21][k] = half;
    }
  }
}

void hessian(std::size_t intervals, const HandColumns& columns) {
  const auto [left_1, left_2, right_1, right_2, tau_1, tau_2, step, time, cost_factor, lambda_left_1, lambda_left_2,
              lambda_right_1, lambda_right_2] = first<13>(columns.in);
  const double factor = columns.factor;
  const auto out = first<12>(columns.out);
  Angles angles;
  for (std::size_t begin = 0; begin < intervals; begin += Angles::width) {
    const std::size_t count = std::min(Angles::width, intervals - begin);
    angles.find(begin, count, columns);
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = begin + i;
      const double h = step[k];
      const double rate = 1.0 / h;
      const double w1 = (right_1[k] - left_1[k]) * rate;
      const double w2 = (right_2[k] - left_2[k]) * rate;
      const double S = c * angles.sine[i];
      const double K = c * angles.cosine[i];
      const double alpha_1 = 0.5 * h * (lambda_left_1[k] + lambda_right_1[k]);
      const double alpha_2 = 0.5 * h * (lambda_left_2[k] + lambda_right_2[k]);
      const double delta_1 = lambda_right_1[k] - lambda_left_1[k];
      const double delta_2 = lambda_right_2[k] - lambda_left_2[k];
      const double turn = alpha_2 - alpha_1;
      const double by_D_D = -0.25 * (turn * S * w1 * w2 + K * (delta_1 * w2 + delta_2 * w1));  // ¼ ℓ_DD
      const double own_1 = by_D_D + 0.25 * alpha_1 * g1 * angles.cosine_1[i];                  // ¼ ℓ by θ₁ twice
      const double own_2 = by_D_D + 0.25 * alpha_2 * g2 * angles.cosine_2[i];
      const double by_D_w1 = 0.5 * rate * (turn * K * w2 - S * delta_2);  // ½ ℓ_Dω₁ / h
      const double by_D_w2 = 0.5 * rate * (turn * K * w1 - S * delta_1);
      const double by_w1_w2 = turn * S * rate * rate;  // ℓ_ω₁ω₂ / h²
      // Rows and columns: θ₁, θ₂ on the left, θ₁, θ₂ on the right, τ₁, τ₂.
      out[0][k] = own_1 - 2.0 * by_D_w1;
      out[1][k] = by_D_w1 - by_D_w2 - by_D_D + by_w1_w2;
      out[2][k] = own_2 + 2.0 * by_D_w2;
      out[3][k] = own_1;
      out[4][k] = -by_D_w1 - by_D_w2 - by_D_D - by_w1_w2;
      out[5][k] = own_1 + 2.0 * by_D_w1;
      out[6][k] = by_D_w1 + by_D_w2 - by_D_D - by_w1_w2;
      out[7][k] = own_2;
      out[8][k] = by_D_w2 - by_D_w1 - by_D_D + by_w1_w2;
      out[9][k] = own_2 - 2.0 * by_D_w2;
      out[10][k] = factor * h;
      out[11][k] = factor * h;
    }
  }
}

}  // namespace

namespace DMOCBENCH_KERNELS {

HandFunctions two_link_manipulator() { return {residual, jacobian, hessian}; }

}  // namespace DMOCBENCH_KERNELS

}  // namespace dmocbench::speed
