// Compares the pendulum's acceleration with what one finds by hand, u - g sin θ.
#include <cmath>
#include <iostream>

#include <pendulum.hpp>

#include "methods/mechanics/equations_of_motion.hpp"

int main() {
  const auto number = [](double value) { return Eigen::VectorXd::Constant(1, value); };
  const Pendulum problem;
  const TracedProblem traced(problem);
  const double angle = 1.0;
  const double torque = 0.5;
  const double found = EquationsOfMotion(traced).acceleration(number(angle), number(2.0), number(torque), 0.0)[0];
  std::cout << "pendulum: acceleration " << found << " rad/s^2\n";
  return std::abs(found - (torque - 9.81 * std::sin(angle))) < 1e-13 ? 0 : 1;
}
