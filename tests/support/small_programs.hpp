#pragma once

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "methods/program/nonlinear_program.hpp"
#include "tests/support/hyper_dual.hpp"

namespace dmocbench::tests {

using HyperVector = std::vector<HyperDual>;

/// A dense program of a few variables, written as formulas and differentiated by hyper-dual numbers.
class SmallProgram : public NonlinearProgram {
 public:
  struct Statement {
    std::function<HyperDual(const HyperVector&)> objective;
    std::function<HyperVector(const HyperVector&)> rows;
    Eigen::VectorXd variable_lower;
    Eigen::VectorXd variable_upper;
    Eigen::VectorXd row_lower;
    Eigen::VectorXd row_upper;
  };

  explicit SmallProgram(Statement statement) : statement_(std::move(statement)) {
    for (std::size_t j = 0; j < variable_count(); ++j) {
      for (std::size_t i = 0; i < constraint_count(); ++i) jacobian_.append(i, j);
      for (std::size_t i = j; i < variable_count(); ++i) hessian_.append(i, j);
    }
  }

  [[nodiscard]] std::size_t variable_count() const override { return size(statement_.variable_lower); }
  [[nodiscard]] std::size_t constraint_count() const override { return size(statement_.row_lower); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return statement_.variable_lower; }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return statement_.variable_upper; }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return statement_.row_lower; }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return statement_.row_upper; }
  [[nodiscard]] const BlockPattern& jacobian_structure() const override { return jacobian_; }
  [[nodiscard]] const BlockPattern& hessian_structure() const override { return hessian_; }

  [[nodiscard]] double objective(const VectorIn& x) override { return statement_.objective(seeded(x, -1, -1)).x; }
  void gradient(const VectorIn& x, VectorOut result) override {
    for (Eigen::Index j = 0; j < x.size(); ++j) result[j] = statement_.objective(seeded(x, j, -1)).e1;
  }
  void constraints(const VectorIn& x, VectorOut result) override {
    const HyperVector rows = statement_.rows(seeded(x, -1, -1));
    for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = rows[static_cast<std::size_t>(i)].x;
  }
  void jacobian(const VectorIn& x, VectorOut values) override {
    Eigen::Index e = 0;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      for (const HyperDual& row : statement_.rows(seeded(x, j, -1))) values[e++] = row.e1;
    }
  }
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override {
    Eigen::Index e = 0;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      for (Eigen::Index i = j; i < x.size(); ++i) {
        const HyperVector point = seeded(x, j, i);
        double sum = objective_factor * statement_.objective(point).e12;
        Eigen::Index row = 0;
        for (const HyperDual& value : statement_.rows(point)) sum += multipliers[row++] * value.e12;
        values[e++] = sum;
      }
    }
  }

 private:
  static std::size_t size(const Eigen::VectorXd& vector) { return static_cast<std::size_t>(vector.size()); }
  static HyperVector seeded(const VectorIn& x, Eigen::Index first, Eigen::Index second) {
    HyperVector point(x.begin(), x.end());
    if (first >= 0) point[static_cast<std::size_t>(first)].e1 = 1.0;
    if (second >= 0) point[static_cast<std::size_t>(second)].e2 = 1.0;
    return point;
  }

  Statement statement_;
  BlockPattern jacobian_;
  BlockPattern hessian_;
};

inline Eigen::VectorXd vector(std::initializer_list<double> entries) {
  return Eigen::Map<const Eigen::VectorXd>(entries.begin(), static_cast<Eigen::Index>(entries.size()));
}
inline Eigen::VectorXd everywhere(Eigen::Index count, double value) { return Eigen::VectorXd::Constant(count, value); }

/// Free variables and rows equal to `row_values`.
inline SmallProgram equality_program(std::function<HyperDual(const HyperVector&)> objective,
                                     std::function<HyperVector(const HyperVector&)> rows, Eigen::Index variables,
                                     const Eigen::VectorXd& row_values) {
  return SmallProgram({std::move(objective), std::move(rows), everywhere(variables, -unbounded),
                       everywhere(variables, unbounded), row_values, row_values});
}

/// min ½|x - (3, 1)|² with x₁ + x₂ in [lower, upper] and x in [0, 2]².
inline SmallProgram box(double lower, double upper) {
  return SmallProgram({[](const HyperVector& x) {
                         const HyperDual a = x[0] - 3.0;
                         const HyperDual b = x[1] - 1.0;
                         return 0.5 * (a * a + b * b);
                       },
                       [](const HyperVector& x) { return HyperVector{x[0] + x[1]}; }, everywhere(2, 0.0),
                       everywhere(2, 2.0), vector({lower}), vector({upper})});
}

/// Rosenbrock's valley, no rows: minimum 0 at (1, 1).
inline SmallProgram rosenbrock() {
  return equality_program(
      [](const HyperVector& x) {
        const HyperDual a = 1.0 - x[0];
        const HyperDual b = x[1] - x[0] * x[0];
        return a * a + 100.0 * b * b;
      },
      [](const HyperVector&) { return HyperVector(); }, 2, Eigen::VectorXd(0));
}

/// A program of Hock and Schittkowski's collection, with their start and optimum.
struct KnownProgram {
  int number;
  SmallProgram::Statement statement;
  Eigen::VectorXd start;
  Eigen::VectorXd optimum;
  double objective;
};

inline std::vector<KnownProgram> hock_schittkowski() {
  const auto free = [](Eigen::Index n, auto objective, auto rows, Eigen::VectorXd values) {
    return SmallProgram::Statement{objective, rows,  everywhere(n, -unbounded), everywhere(n, unbounded),
                                   values,    values};
  };
  std::vector<KnownProgram> all;
  all.push_back({6,
                 free(
                     2,
                     [](const HyperVector& x) {
                       const HyperDual a = 1.0 - x[0];
                       return a * a;
                     },
                     [](const HyperVector& x) { return HyperVector{10.0 * (x[1] - x[0] * x[0])}; }, vector({0.0})),
                 vector({-1.2, 1.0}), vector({1.0, 1.0}), 0.0});
  all.push_back({7,
                 free(
                     2, [](const HyperVector& x) { return log(1.0 + x[0] * x[0]) - x[1]; },
                     [](const HyperVector& x) {
                       const HyperDual a = 1.0 + x[0] * x[0];
                       return HyperVector{a * a + x[1] * x[1]};
                     },
                     vector({4.0})),
                 vector({2.0, 2.0}), vector({0.0, std::sqrt(3.0)}), -std::sqrt(3.0)});
  all.push_back({39,
                 free(
                     4, [](const HyperVector& x) { return -x[0]; },
                     [](const HyperVector& x) {
                       return HyperVector{x[1] - x[0] * x[0] * x[0] - x[2] * x[2], x[0] * x[0] - x[1] - x[3] * x[3]};
                     },
                     vector({0.0, 0.0})),
                 everywhere(4, 2.0), vector({1.0, 1.0, 0.0, 0.0}), -1.0});
  all.push_back(
      {40,
       free(
           4, [](const HyperVector& x) { return -(x[0] * x[1] * x[2] * x[3]); },
           [](const HyperVector& x) {
             return HyperVector{x[0] * x[0] * x[0] + x[1] * x[1], x[0] * x[0] * x[3] - x[2], x[3] * x[3] - x[1]};
           },
           vector({1.0, 0.0, 0.0})),
       everywhere(4, 0.8),
       vector({std::pow(2.0, -1.0 / 3.0), std::pow(2.0, -0.5), std::pow(2.0, -11.0 / 12.0), std::pow(2.0, -0.25)}),
       -0.25});
  all.push_back(
      {71,
       {[](const HyperVector& x) { return x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]; },
        [](const HyperVector& x) {
          return HyperVector{x[0] * x[1] * x[2] * x[3], x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3]};
        },
        everywhere(4, 1.0), everywhere(4, 5.0), vector({25.0, 40.0}), vector({unbounded, 40.0})},
       vector({1.0, 5.0, 5.0, 1.0}),
       vector({1.0, 4.742999638, 3.821149979, 1.379408293}),
       17.01401729});
  return all;
}

}  // namespace dmocbench::tests
