#include "bench/experiments/derivatives/measured_derivatives.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <span>
#include <utility>

#include "methods/expression/replay.hpp"
#include "methods/numerics/quantile.hpp"
#include "methods/runtime/clock.hpp"

namespace dmocbench {

namespace {

using Position = std::pair<int, int>;

/// Values of a sparse matrix, added up entry by entry.
class SparseSum {
 public:
  explicit SparseSum(const BlockPattern& pattern) : values_(pattern.size(), 0.0L) {
    pattern.for_each([&](Eigen::Index e, int row, int column) {
      entry_at_[{row, column}] = static_cast<std::size_t>(e);
    });
  }
  void add(std::size_t row, std::size_t column, long double value) {
    values_[entry_at_.at({static_cast<int>(row), static_cast<int>(column)})] += value;
  }
  [[nodiscard]] std::vector<long double> values() && { return std::move(values_); }

 private:
  std::map<Position, std::size_t> entry_at_;
  std::vector<long double> values_;
};

constexpr int rounds = 5;
constexpr int rounds_of_long_evaluations = 3;
constexpr double long_evaluation = 1e-3;
constexpr double shortest_round = 3e-5;  // [s]; the clock resolves about 3e-8

double seconds_of(const std::function<void()>& evaluation, int calls) {
  const auto start = Clock::now();
  for (int i = 0; i < calls; ++i) evaluation();
  return seconds_since(start);
}

}  // namespace

DerivativeReference reference_derivatives(const Transcription& program, const Eigen::VectorXd& x,
                                          double objective_factor, const Eigen::VectorXd& multipliers) {
  SparseSum jacobian(program.jacobian_structure());
  SparseSum hessian(program.hessian_structure());
  const auto add = [&](const LocalFunctions& functions, const std::vector<SeriesPlace>& unknowns,
                       const std::vector<SeriesPlace>& rows, std::size_t intervals) {
    const LocalInputs& numbers = functions.inputs;
    std::vector<long double> inputs(numbers.count());
    inputs[numbers.objective_factor()] = objective_factor;
    for (std::size_t k = 0; k < intervals; ++k) {
      const auto unknown = [&](std::size_t a) { return unknowns[a].at(k); };
      const auto row = [&](std::size_t r) { return rows[r].at(k); };
      for (std::size_t a = 0; a < numbers.unknowns; ++a) inputs[a] = x[static_cast<Eigen::Index>(unknown(a))];
      inputs[numbers.step()] = program.step_inputs()[static_cast<Eigen::Index>(k)];
      inputs[numbers.time()] = program.time_inputs()[static_cast<Eigen::Index>(k)];
      for (std::size_t r = 0; r < numbers.rows; ++r) {
        inputs[numbers.multiplier(r)] = multipliers[static_cast<Eigen::Index>(row(r))];
      }
      const std::span<const long double> point(inputs);
      const std::vector<long double> first = replay<long double>(functions.jacobian.schedule, point);
      for (std::size_t e = 0; e < first.size(); ++e) {
        jacobian.add(row(functions.jacobian.rows[e]), unknown(functions.jacobian.columns[e]), first[e]);
      }
      const std::vector<long double> second = replay<long double>(functions.hessian.schedule, point);
      for (std::size_t e = 0; e < second.size(); ++e) {
        const auto [column, lower] =
            std::minmax({unknown(functions.hessian.rows[e]), unknown(functions.hessian.columns[e])});
        hessian.add(lower, column, second[e]);
      }
    }
  };
  const ProgramBlocks& blocks = program.blocks();
  add(program.functions(), blocks.unknown_places(), blocks.row_places(), blocks.intervals());
  if (const std::optional<EndFunctions>& ends = program.end_functions()) {
    add(*ends, blocks.end_unknown_places(), blocks.end_row_places(), 1);
  }
  return {std::move(jacobian).values(), std::move(hessian).values()};
}

double relative_error(const Eigen::VectorXd& values, const std::vector<long double>& reference) {
  long double largest = 0.0L;
  long double difference = 0.0L;
  for (std::size_t e = 0; e < reference.size(); ++e) {
    const double value = values[static_cast<Eigen::Index>(e)];
    if (std::isnan(value)) return value;
    largest = std::max(largest, std::abs(reference[e]));
    difference = std::max(difference, std::abs(value - reference[e]));
  }
  return static_cast<double>(difference / largest);
}

EvaluationTimes measure_evaluations(NonlinearProgram& program, const Eigen::VectorXd& x,
                                    const Eigen::VectorXd& multipliers) {
  Eigen::VectorXd gradient(x.size());
  Eigen::VectorXd residual(multipliers.size());
  Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  Eigen::VectorXd hessian(static_cast<Eigen::Index>(program.hessian_structure().size()));
  const std::array<std::function<void()>, 4> evaluations{
      [&] { program.constraints(x, residual); }, [&] { program.gradient(x, gradient); },
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
  return {.residual = median(seconds[0]),
          .gradient = median(seconds[1]),
          .jacobian = median(seconds[2]),
          .hessian = median(seconds[3])};
}

}  // namespace dmocbench
