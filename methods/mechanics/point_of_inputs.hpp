#pragma once

#include "methods/expression/vectors.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// The point whose entries are the next inputs, in the order q (n entries), v (n), u (m), y (l), t.
[[nodiscard]] inline ControlledState take_point(InputCounter& inputs, Eigen::Index n, Eigen::Index m, Eigen::Index l) {
  ControlledState x{inputs.take(n), inputs.take(n), inputs.take(m), {}, inputs.take(l)};
  x.t = inputs.take();
  return x;
}

/// The same with the sizes of a `Problem` or of a `TracedProblem`.
template <class Sizes>
[[nodiscard]] ControlledState take_point(InputCounter& inputs, const Sizes& problem) {
  return take_point(inputs, problem.configuration_size(), problem.control_size(), problem.first_order_size());
}

/// The same from input 0 on.
template <class Sizes>
[[nodiscard]] ControlledState point_of_inputs(const Sizes& problem) {
  InputCounter inputs;
  return take_point(inputs, problem);
}

}  // namespace dmocbench
