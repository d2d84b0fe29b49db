#include "methods/indirect/shooting_defect.hpp"

#include <algorithm>
#include <vector>

#include "methods/error.hpp"
#include "methods/indirect/pontryagin_function.hpp"
#include "methods/numerics/adaptive_integration.hpp"

namespace dmocbench {

double shooting_defect(const Problem& problem, const IndirectSolution& solution, double tolerance) {
  using Extremal = std::vector<double>;
  const PontryaginFunction function(problem);
  const CollocatedExtremal& extremal = solution.extremal();
  const Eigen::VectorXd times = solution.node_times();
  const Eigen::Index half = function.state_size() / 2;
  constexpr double vanishing = 1e-6;  // costates of a free motion are 0
  const double state = std::max(vanishing, extremal.nodes.topRows(half).lpNorm<Eigen::Infinity>());
  const double costate = std::max(vanishing, extremal.nodes.bottomRows(half).lpNorm<Eigen::Infinity>());

  double largest = 0.0;
  for (Eigen::Index k = 0; k < extremal.intervals(); ++k) {
    Eigen::VectorXd z = extremal.algebraic.col(k * extremal.stages);
    const auto equations = [&](const Extremal& y, Extremal& rate, double t) {
      const Eigen::Map<const Eigen::VectorXd> point(y.data(), 2 * half);
      Eigen::Map<Eigen::VectorXd>(rate.data(), 2 * half) = function.evaluate(point, t, z).rate;
    };
    Extremal y(extremal.nodes.col(k).begin(), extremal.nodes.col(k).end());
    if (!integrate(equations, y, times[k], times[k + 1], times[k + 1] - times[k], tolerance)) {
      throw Error("the step size of the shooting check vanished in interval " + std::to_string(k));
    }
    const Eigen::VectorXd mismatch = Eigen::Map<const Eigen::VectorXd>(y.data(), 2 * half) - extremal.nodes.col(k + 1);
    largest = std::max({largest, mismatch.head(half).lpNorm<Eigen::Infinity>() / state,
                        mismatch.tail(half).lpNorm<Eigen::Infinity>() / costate});
  }
  return largest;
}

}  // namespace dmocbench
