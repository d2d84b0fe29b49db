#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/dense_kkt.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/random_structured_program.hpp"

namespace dmocbench::tests {

/// Draws shapes of programs, and what belongs to a system with one.
class SystemChoice {
 public:
  explicit SystemChoice(unsigned seed) : random_(seed) {}

  RandomShape shape() {
    constexpr std::array roughnesses{0.0, 0.01, 0.1, 0.5};
    RandomShape shape;
    shape.node = whole(1, 4);
    shape.rows_at_nodes = chance(0.5);
    shape.rates = chance(0.5) ? 0 : whole(1, 4);
    shape.controls = whole(1, 3);
    shape.inequalities = chance(0.6) ? 0 : whole(1, 3);
    shape.horizon = chance(0.3);
    for (const std::size_t end : {0U, 1U}) {
      shape.velocity[end] = chance(0.4);
      shape.fixed[end] = chance(0.6) ? shape.node : whole(0, shape.node);
    }
    shape.conditions = chance(0.7) ? 0 : whole(1, 2);
    shape.condition_is_inequality = chance(0.3);
    shape.fixes_control = shape.controls > 1 && chance(0.1);
    shape.rates_cost_nothing = shape.rates > 0 && chance(0.5);
    shape.drops_entries = chance(0.3);
    shape.nearly_dependent = chance(0.05);
    shape.roughness = roughnesses.at(static_cast<std::size_t>(whole(0, 3)));
    shape.coupling = magnitude(0.05, 1.0);
    shape.hessian = static_cast<RandomShape::Hessian>(whole(0, 3));
    shape.intervals = intervals(shape);
    return shape;
  }

  KktNumbers numbers(RandomStructuredProgram& program, RandomShape::Hessian hessian) {
    const auto n = static_cast<Eigen::Index>(program.variable_count());
    const auto m = static_cast<Eigen::Index>(program.constraint_count());
    KktNumbers numbers;
    numbers.hessian.resize(static_cast<Eigen::Index>(program.hessian_structure().size()));
    numbers.jacobian.resize(static_cast<Eigen::Index>(program.jacobian_structure().size()));
    program.hessian(Eigen::VectorXd::Zero(n), 1.0, Eigen::VectorXd::Zero(m), numbers.hessian);
    program.jacobian(Eigen::VectorXd::Zero(n), numbers.jacobian);
    numbers.diagonal = shift_for(hessian) * (1.0 + random_.vector(n, 0.0, 0.5).array());
    numbers.compliance.setZero(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      if (program.constraint_lower()[i] == program.constraint_upper()[i]) continue;
      numbers.compliance[i] = magnitude(1e-3, 10.0);
    }
    numbers.gradient = random_.vector(n);
    numbers.rows = random_.vector(m);
    return numbers;
  }

 private:
  bool chance(double probability) { return random_.number(0.0, 1.0) < probability; }
  Eigen::Index whole(Eigen::Index least, Eigen::Index most) {
    return least + static_cast<Eigen::Index>(random_.number(0.0, 1.0) * static_cast<double>(most - least + 1));
  }
  double magnitude(double smallest, double largest) {
    return smallest * std::pow(largest / smallest, random_.number(0.0, 1.0));
  }
  double shift_for(RandomShape::Hessian hessian) {
    if (hessian == RandomShape::Hessian::indefinite) return random_.number(0.0, 2.0);
    return hessian == RandomShape::Hessian::nearly_singular ? magnitude(1e-8, 1e-2) : 0.0;
  }
  /// 1 .. 40, fewer where intervals are large, so that dense linear algebra stays fast; often fewer than lanes. Where
  /// both ends have further unknowns a grid of one interval cannot tell them from a column of nodes.
  std::size_t intervals(const RandomShape& shape) {
    const Eigen::Index of_interval = 2 * (shape.node + shape.rates) + shape.controls + shape.inequalities;
    const Eigen::Index most = chance(0.3) ? 8 : std::min<Eigen::Index>(40, 240 / of_interval);
    return static_cast<std::size_t>(whole(shape.velocity[0] && shape.velocity[1] ? 2 : 1, most));
  }

  RandomPoints random_;
};

}  // namespace dmocbench::tests
