// Compares the derivative of a pendulum's potential with what one finds by hand, g sin θ.
#include <array>
#include <cmath>
#include <iostream>

#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"

using namespace dmocbench;

int main() {
  const Expression theta = Expression::input(0);
  const ExpressionVector slope = gradient(-9.81 * cos(theta), ExpressionVector::Constant(1, theta));
  const std::array<double, 1> angle{1.0};
  const double found = replay<double>(Schedule(slope), angle)[0];
  std::cout << "pendulum: torque of its weight " << found << " N m\n";
  return std::abs(found - 9.81 * std::sin(angle[0])) < 1e-14 ? 0 : 1;
}
