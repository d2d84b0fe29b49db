#pragma once

#include <functional>

#include <Eigen/Core>

#include "methods/expression/vectors.hpp"

namespace dmocbench {

using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// A control as a formula of time, m entries.
using ControlFormula = std::function<ExpressionVector(const Expression& t)>;

/// The discrete mechanical objects of one interval [0, h] with end points q_0, q_1, approximate or exact.
struct DiscreteObjects {
  long double lagrangian = 0.0L;  ///< L_d(q_0, q_1)
  LongVector left_force;          ///< f_d^-, n entries
  LongVector right_force;         ///< f_d^+
  LongVector left_momentum;       ///< p_0 of the forced discrete Legendre transform (eq:varmech_dlegf-)
  LongVector right_momentum;      ///< p_1 of (eq:varmech_dlegf+)
};

}  // namespace dmocbench
