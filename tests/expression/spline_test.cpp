#include "methods/expression/spline.hpp"

#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "methods/expression/derivatives.hpp"
#include "methods/runtime/instruction_set.hpp"
#include "tests/expression/series_table.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

const std::vector<double>& table_x() {
  static const std::vector<double> x{-1.0, -0.2, 0.0, 0.7, 2.0, 2.1};
  return x;
}
const std::vector<double>& table_y() {
  static const std::vector<double> y{0.3, -0.8, 1.5, 1.4, -2.0, 0.1};
  return y;
}

/// The natural spline by its definition: four coefficients of (x - x_i)^k per interval, from values at both ends, equal
/// first and second derivatives at the points between, and s'' = 0 at both ends; straight lines beyond.
class SplineByDefinition {
 public:
  SplineByDefinition() {
    const auto intervals = static_cast<Eigen::Index>(table_x().size()) - 1;
    Eigen::MatrixXd conditions = Eigen::MatrixXd::Zero(4 * intervals, 4 * intervals);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(4 * intervals);
    Eigen::Index row = 0;
    const auto add = [&](Eigen::Index interval, int order, double distance, double sign) {
      conditions.row(row).segment<4>(4 * interval) += sign * powers(distance, order).transpose();
    };
    for (Eigen::Index i = 0; i < intervals; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double h = table_x()[at + 1] - table_x()[at];
      add(i, 0, 0.0, 1.0);
      values[row++] = table_y()[at];
      add(i, 0, h, 1.0);
      values[row++] = table_y()[at + 1];
      for (int order = 1; order <= 2 && i + 1 < intervals; ++order) {
        add(i, order, h, 1.0);
        add(i + 1, order, 0.0, -1.0);
        ++row;
      }
      if (i == 0) add(i, 2, 0.0, 1.0), ++row;
      if (i + 1 == intervals) add(i, 2, h, 1.0), ++row;
    }
    coefficients_ = conditions.partialPivLu().solve(values);
  }

  /// s, s' or s'' at x.
  [[nodiscard]] double at(double x, int order) const {
    const double inside = std::min(std::max(x, table_x().front()), table_x().back());
    if (inside != x) {
      const double slope = at(inside, 1);
      return order == 0 ? at(inside, 0) + slope * (x - inside) : order == 1 ? slope : 0.0;
    }
    std::size_t i = 0;
    while (i + 2 < table_x().size() && table_x()[i + 1] < x) ++i;
    return powers(x - table_x()[i], order).dot(coefficients_.segment<4>(4 * static_cast<Eigen::Index>(i)));
  }

 private:
  static Eigen::Vector4d powers(double d, int order) {
    if (order == 0) return {1.0, d, d * d, d * d * d};
    if (order == 1) return {0.0, 1.0, 2.0 * d, 3.0 * d * d};
    return {0.0, 0.0, 2.0, 6.0 * d};
  }
  Eigen::VectorXd coefficients_;
};

/// Inside every interval, beyond both ends, at the points themselves and one rounding beside them.
std::vector<double> places() {
  std::vector<double> places{-7.0, 9.0, -1e-300, 1e-300};
  tests::RandomPoints random;
  for (int i = 0; i < 60; ++i) places.push_back(random.number(-1.5, 2.5));
  for (const double x : table_x()) {
    for (const double side : {-10.0, 10.0}) places.push_back(std::nextafter(x, side));
    places.push_back(x);
  }
  return places;
}

/// s, s' and s'' as formulas.
ExpressionVector traced(const Spline& spline) {
  const ExpressionVector x = input_vector(0, 1);
  const Expression s = spline(x[0]);
  return ExpressionVector{{s, gradient(s, x)[0], hessian(s, x)(0, 0)}};
}

TEST(Spline, AndItsFirstTwoDerivativesAreThoseOfTheDefinitionWithEveryInstructionSet) {
  const Spline spline(table_x(), table_y());
  const SplineByDefinition definition;
  const std::vector<double> points = places();
  for (const InstructionSet set : available_instruction_sets()) {
    const tests::SeriesTable found = tests::evaluate(Tape(Schedule(traced(spline)), set), {points}, points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      for (int order = 0; order <= 2; ++order) {
        const double expected = definition.at(points[k], order);
        EXPECT_NEAR(found[static_cast<std::size_t>(order)][k], expected, 1e-12 * (1.0 + std::abs(points[k])) * 500.0)
            << name_of(set) << ", order " << order << " at " << points[k];
      }
    }
  }
}

TEST(Spline, TakesTheValuesOfItsTable) {
  const Spline spline(table_x(), table_y());
  for (std::size_t i = 0; i < table_x().size(); ++i) EXPECT_NEAR(spline(table_x()[i]), table_y()[i], 1e-15 * 8.0);
}

TEST(Spline, OfNumbersIsThatOfTracedNumbers) {
  const Spline spline(table_x(), table_y());
  const Schedule schedule(ExpressionVector{{spline(Expression::input(0))}});
  for (const double x : places()) {
    EXPECT_NEAR(replay<double>(schedule, std::span<const double>(&x, 1))[0], spline(x), 1e-15 * (8.0 + std::abs(x)));
  }
}

TEST(Spline, ThroughTwoPointsIsAStraightLine) {
  const Spline line({1.0, 3.0}, {5.0, 9.0});
  for (const double x : {-4.0, 1.0, 2.0, 3.0, 8.0}) EXPECT_NEAR(line(x), 3.0 + 2.0 * x, 1e-14);
}

TEST(Spline, PassesNanOn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Schedule schedule(ExpressionVector{{Spline(table_x(), table_y())(Expression::input(0))}});
  EXPECT_TRUE(std::isnan(replay<double>(schedule, std::span<const double>(&nan, 1))[0]));
  EXPECT_TRUE(std::isnan(tests::evaluate(Tape(schedule), {{nan}}, 1)[0][0]));
}

TEST(Spline, RefusesTablesThatAreNoneNamingThePoint) {
  const auto make = [](const std::vector<double>& x, const std::vector<double>& y) { return [=] { Spline(x, y); }; };
  tests::expect_error_naming({"3 x values but 2 y values"}, make({0.0, 1.0, 2.0}, {0.0, 1.0}));
  tests::expect_error_naming({"at least two points", "got 1"}, make({0.0}, {0.0}));
  tests::expect_error_naming({"increasing", "point 3", "(1, 7)"}, make({0.0, 1.0, 1.0}, {0.0, 1.0, 7.0}));
  tests::expect_error_naming({"finite", "point 2"}, make({0.0, 1.0}, {0.0, std::nan("")}));
}

}  // namespace
}  // namespace dmocbench
