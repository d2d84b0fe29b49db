#include "bench/derivatives/evaluation_times.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <vector>

namespace dmocbench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int rounds = 5;
constexpr int rounds_of_long_evaluations = 3;
constexpr double long_evaluation = 1e-3;
constexpr double shortest_round = 3e-5;  // [s]; the clock tells some 3e-8

double seconds_of(const std::function<void()>& evaluation, int calls) {
  const auto start = Clock::now();
  for (int i = 0; i < calls; ++i) evaluation();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

EvaluationTimes measure_evaluations(NonlinearProgram& program, const Eigen::VectorXd& x,
                                    const Eigen::VectorXd& multipliers) {
  Eigen::VectorXd gradient(x.size());
  Eigen::VectorXd rows(multipliers.size());
  Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  Eigen::VectorXd hessian(static_cast<Eigen::Index>(program.hessian_structure().size()));
  const std::array<std::function<void()>, 4> evaluations{
      [&] { program.constraints(x, rows); }, [&] { program.gradient(x, gradient); },
      [&] { program.jacobian(x, jacobian); }, [&] { program.hessian(x, 1.0, multipliers, hessian); }};

  std::array<int, evaluations.size()> calls{};
  std::array<bool, evaluations.size()> is_long{};
  calls.fill(1);
  for (std::size_t i = 0; i < evaluations.size(); ++i) {
    const double first = seconds_of(evaluations[i], 1);
    is_long[i] = first > long_evaluation;
    if (is_long[i]) continue;
    // The first call is not like the others.
    calls[i] = std::max(1, static_cast<int>(std::ceil(shortest_round / seconds_of(evaluations[i], 1))));
  }
  std::array<std::vector<double>, evaluations.size()> seconds;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < evaluations.size(); ++i) {
      if (is_long[i] && round >= rounds_of_long_evaluations) continue;
      seconds[i].push_back(seconds_of(evaluations[i], calls[i]) / calls[i]);
    }
  }
  const auto median = [&](std::size_t i) {
    std::vector<double>& all = seconds[i];
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
  };
  return {.residual = median(0), .gradient = median(1), .jacobian = median(2), .hessian = median(3)};
}

}  // namespace dmocbench
