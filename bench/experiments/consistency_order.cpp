// The order of consistency of DMOC's discrete Lagrangian, forces, Legendre transforms and map: th:ordercalculation.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <tl/expected.hpp>

#include "bench/run/column.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/options.hpp"
#include "bench/run/table_run.hpp"
#include "methods/diagnostics/exact_discrete_lagrangian.hpp"
#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench::consistency_order_program {

/// The quantities that are compared with the exact ones, with their names in the tables.
constexpr std::array<std::pair<const char*, double ConsistencyErrors::*>, 6> quantities{
    {{"lagrangian", &ConsistencyErrors::lagrangian},
     {"left_force", &ConsistencyErrors::left_force},
     {"right_force", &ConsistencyErrors::right_force},
     {"left_legendre", &ConsistencyErrors::left_legendre},
     {"right_legendre", &ConsistencyErrors::right_legendre},
     {"map", &ConsistencyErrors::map}}};

/// u_j = 1/2 + sin(2πt/T + j): smooth, and nowhere stationary with all its derivatives.
ControlFormula smooth_control(const Problem& problem) {
  const double frequency = 2.0 * std::acos(-1.0) / problem.horizon();
  const Eigen::Index m = problem.control_size();
  return [=](const Expression& t) {
    ExpressionVector u(m);
    for (Eigen::Index j = 0; j < m; ++j) u[j] = 0.5 + sin(frequency * t + static_cast<double>(j));
    return u;
  };
}

/// Initial conditions around the guess a quarter of the way, so that no error vanishes by a coincidence of one motion.
std::vector<BoundaryState> initial_conditions(const Problem& problem) {
  constexpr int motions = 8;
  constexpr double width = 0.1;
  const MotionPoint centre = problem.guess(problem.horizon() / 4.0);
  std::vector<BoundaryState> starts(motions, {centre.q, centre.v});
  for (int k = 1; k < motions; ++k) {
    BoundaryState& start = starts[static_cast<std::size_t>(k)];
    for (Eigen::Index i = 0; i < centre.q.size(); ++i) {
      start.q[i] += width * std::cos(k * (1.0 + static_cast<double>(i))) * std::max(1.0, std::abs(centre.q[i]));
      start.v[i] += width * std::sin(k * (2.0 + static_cast<double>(i))) * std::max(1.0, std::abs(centre.v[i]));
    }
  }
  return starts;
}

/// A measured error, or a fitted order, of a quantity.
template <class Value>
struct Measured {
  std::string problem;
  std::string tableau;
  Eigen::Index stages = 0;
  int order = 0;
  std::string quantity;
  Value value;
};

/// The columns that begin both tables.
template <class Record>
Columns<Record> first_columns() {
  return {{"problem", "", "name of the problem", &Record::problem, in_key},
          {"tableau", "", "family of Butcher tableaus", &Record::tableau, in_key},
          {"stages", "", "number of stages", &Record::stages, in_key},
          {"order", "", "order of the tableau", &Record::order, in_key},
          {"quantity", "", "quantity that is compared with its exact value", &Record::quantity, in_key}};
}

/// The error measured on one step; empty if an equation has no solution for it.
struct ErrorOfStep {
  double h = 0.0;
  std::optional<double> error;
  std::string message;
};

using MeasuredError = Measured<ErrorOfStep>;
const Columns<MeasuredError> error_columns =
    first_columns<MeasuredError>() +
    Columns<MeasuredError>{
        {"h", "", "step", from(&MeasuredError::value, &ErrorOfStep::h), in_key},
        {"error", "", "largest error over the initial conditions", from(&MeasuredError::value, &ErrorOfStep::error)},
        {"message", "", "reason for a missing error", from(&MeasuredError::value, &ErrorOfStep::message)}};

using MeasuredOrder = Measured<FittedOrder>;
const Columns<MeasuredOrder> order_columns =
    first_columns<MeasuredOrder>() + fitted_order_columns(&MeasuredOrder::value);

struct Results {
  std::vector<MeasuredError> errors;
  std::vector<MeasuredOrder> orders;
};

/// A line through the finest six points that are clear of rounding. Errors below are due to the tableau's coefficients,
/// which are double. Six points span a factor of six in h; coarser steps would still show the next power of h.
std::optional<FittedOrder> fit_finest(std::vector<GridError> points) {
  constexpr double rounding = 1e-15;
  constexpr std::size_t fitted = 6;
  std::erase_if(points, [](const GridError& point) { return point.error < rounding; });
  std::ranges::sort(points, {}, &GridError::step);
  points.resize(std::min(points.size(), fitted));
  return fit_order(points);
}

/// Steps T/N, coarsest first.
void measure(const Problem& problem, const std::vector<long long>& intervals, Results& results) {
  const std::vector<Tableau> tableaus = one_step_tableaus();
  const ConsistencyOrder order(problem, smooth_control(problem), initial_conditions(problem));
  std::vector<tl::expected<std::vector<ConsistencyErrors>, std::string>> errors;  // per step, then per tableau
  const auto step = [&](std::size_t k) { return problem.horizon() / static_cast<double>(intervals[k]); };
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    throw_if_interrupted();
    errors.push_back(measured_or_reason([&] { return order.errors(tableaus, step(k)); }));
  }
  for (std::size_t i = 0; i < tableaus.size(); ++i) {
    for (const auto& [quantity, error] : quantities) {
      const auto measured = [&, quantity = quantity]<class Value>(const Value& value) {
        const Tableau& tableau = tableaus[i];
        return Measured<Value>{problem.name(), tableau.family, tableau.stages(), tableau.order, quantity, value};
      };
      std::vector<GridError> points;
      for (std::size_t k = 0; k < intervals.size(); ++k) {
        if (!errors[k]) {
          results.errors.push_back(measured(ErrorOfStep{step(k), std::nullopt, errors[k].error()}));
          continue;
        }
        points.push_back({step(k), (*errors[k])[i].*error});
        results.errors.push_back(measured(ErrorOfStep{step(k), points.back().error, ""}));
      }
      if (const auto fitted = fit_finest(points)) results.orders.push_back(measured(*fitted));
    }
  }
}

/// The Lemma 𝔽^{f±}L_d^E = 𝔽L: the largest distance of the exact forced discrete Legendre transforms, with derivatives
/// of L_d^E by differences, from the momenta L_v at the ends of the exact motion.
struct ExactTransform {
  std::string problem;
  double h = 0.0;
  std::optional<double> left{};  ///< all are empty if the exact motion could not be found
  std::optional<double> right{};
  std::optional<double> momentum{};
  std::optional<double> force_error{};  ///< of the midpoint rule, like its exterior derivative
  std::optional<double> force_error_curl{};
};

const Columns<ExactTransform> transform_columns{
    {"problem", "", "name of the problem", &ExactTransform::problem, in_key},
    {"h", "", "step", &ExactTransform::h, in_key},
    {"left_defect", "", "max of |-D_1 L_d^E - f_d^{E-} - L_v(0)|", &ExactTransform::left},
    {"right_defect", "", "max of |D_2 L_d^E + f_d^{E+} - L_v(h)|", &ExactTransform::right},
    {"largest_momentum", "", "largest entry of L_v, the scale of both defects", &ExactTransform::momentum},
    {"force_error", "", "largest entry of omega = f_d - f_d^E on Q x Q for the midpoint rule",
     &ExactTransform::force_error},
    {"force_error_curl", "", "h times the largest entry of d omega, which is 0 if omega is a differential",
     &ExactTransform::force_error_curl}};

/// f'(0) by differences of order 4.
template <class Function>
auto derivative_at_0(const Function& f, long double e) -> decltype(f(e)) {
  return (8.0L * (f(e) - f(-e)) - (f(2.0L * e) - f(-2.0L * e))) / (12.0L * e);
}

/// D_1 L_d^E and D_2 L_d^E along e_i, from boundary value problems with moved ends.
std::pair<long double, long double> derivatives_of_exact_lagrangian(const ExactDiscreteLagrangian& exact,
                                                                    const ExactInterval& at, long double h,
                                                                    Eigen::Index i) {
  const long double e = 1e-3L * h;
  const LongVector unit = LongVector::Unit(at.q_0.size(), i);
  const auto lagrangian = [&](long double left, long double right) {
    return exact.between(at.q_0 + left * unit, at.q_1 + right * unit, at.v_0, h).objects.lagrangian;
  };
  return {derivative_at_0([&](long double x) { return lagrangian(x, 0.0L); }, e),
          derivative_at_0([&](long double x) { return lagrangian(0.0L, x); }, e)};
}

/// ω = f_d - f_d^E of the midpoint rule as a one-form on Q × Q, (left, right).
class ErrorOfForces {
 public:
  ErrorOfForces(const Problem& problem, const ExactDiscreteLagrangian& exact)
      : exact_(exact), discrete_(problem, make_tableau("gauss", 1)) {}

  /// Between the ends of an exact motion, moved by `by` (2n entries).
  [[nodiscard]] LongVector at(const ExactInterval& at, const LongVector& by, long double h) const {
    const Eigen::Index n = at.q_0.size();
    const LongVector left = at.q_0 + by.head(n);
    const LongVector right = at.q_1 + by.tail(n);
    const LongMatrix controls = exact_.control(h / 2.0L).transpose();
    const DiscreteObjects discrete = discrete_.at(left, right, controls, h, 0.0L);
    const DiscreteObjects exact = exact_.between(left, right, at.v_0, h).objects;
    LongVector error(2 * n);
    error << discrete.left_force - exact.left_force, discrete.right_force - exact.right_force;
    return error;
  }
  /// The largest |∂ω_i/∂x_j - ∂ω_j/∂x_i|.
  [[nodiscard]] long double curl(const ExactInterval& at, long double h) const {
    const Eigen::Index size = 2 * at.q_0.size();
    LongMatrix jacobian(size, size);
    for (Eigen::Index j = 0; j < size; ++j) {
      const auto moved = [&](long double x) { return this->at(at, x * LongVector::Unit(size, j), h); };
      jacobian.col(j) = derivative_at_0(moved, 1e-3L * h);
    }
    return (jacobian - jacobian.transpose()).cwiseAbs().maxCoeff();
  }

 private:
  const ExactDiscreteLagrangian& exact_;
  DiscreteLagrangian discrete_;
};

ExactTransform exact_transform(const Problem& problem, long long intervals) {
  ExactTransform result{.problem = problem.name(), .h = problem.horizon() / static_cast<double>(intervals)};
  const ExactDiscreteLagrangian exact(problem, smooth_control(problem));
  const ErrorOfForces error_of_forces(problem, exact);
  const auto raise = [](std::optional<double>& largest, long double value) {
    largest = std::max(largest.value_or(0.0), static_cast<double>(std::abs(value)));
  };
  try {
    for (const BoundaryState& start : initial_conditions(problem)) {
      throw_if_interrupted();
      const ExactInterval at = exact.along(start.q.cast<long double>(), start.v.cast<long double>(), result.h);
      const LongVector nowhere = LongVector::Zero(2 * at.q_0.size());
      raise(result.force_error, error_of_forces.at(at, nowhere, result.h).cwiseAbs().maxCoeff());
      raise(result.force_error_curl, result.h * error_of_forces.curl(at, result.h));
      for (Eigen::Index i = 0; i < at.q_0.size(); ++i) {
        const auto [by_left, by_right] = derivatives_of_exact_lagrangian(exact, at, result.h, i);
        raise(result.left, -by_left - at.objects.left_force[i] - at.objects.left_momentum[i]);
        raise(result.right, by_right + at.objects.right_force[i] - at.objects.right_momentum[i]);
        raise(result.momentum, at.objects.left_momentum[i]);
        raise(result.momentum, at.objects.right_momentum[i]);
      }
    }
  } catch (const Stopped&) {
    throw;
  } catch (const Error&) {  // the errors of the same step, measured before, have the reason
    result = {.problem = result.problem, .h = result.h};
  }
  return result;
}

int measure_all(CommandLine& line) {
  ProblemOptions asked{.problems = {"all"}};
  std::string intervals = "32,48,64,96,128,192,256,384,512,768,1024";
  asked.add_to(line);
  line.option("--intervals", intervals, "numbers N of intervals with h = T/N: a list, or a doubling range first:last");
  TableRun run("consistency_order", line);
  const std::vector<long long> steps = parse_intervals("--intervals", intervals);
  remark(remark_on_ranges("--intervals", intervals));
  const auto selected = run.selected(asked);
  Results results;
  std::vector<ExactTransform> transforms;
  for (const auto& problem : selected) {
    run.show(problem->name());
    measure(*problem, steps, results);
    for (const long long coarsest_and_finest : {steps.front(), steps.back()}) {
      transforms.push_back(exact_transform(*problem, coarsest_and_finest));
    }
  }
  const auto failures =
      std::ranges::count_if(results.errors, [](const MeasuredError& row) { return !row.value.error; });
  run.add("consistency_order", error_columns, results.errors, failures);
  run.add("consistency_order_slopes", order_columns, results.orders);
  run.add("consistency_order_transforms", transform_columns, transforms);
  return run.write();
}

int run(int argc, char** argv) {
  return run_program(
      "consistency_order",
      "Measures orders of consistency. For steps h = T/N and every tableau, consistency_order.csv has the errors of "
      "DMOC's discrete Lagrangian, forces, Legendre transforms and one-step map, and consistency_order_slopes.csv has "
      "their orders. For the largest and the smallest step, consistency_order_transforms.csv compares the exact "
      "discrete Legendre transforms with the transforms of L, and has the error of the midpoint rule's forces and the "
      "exterior derivative of this error.",
      argc, argv, measure_all);
}

}  // namespace dmocbench::consistency_order_program
