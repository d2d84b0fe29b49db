#pragma once

#include <memory>

#include "methods/judgement/linearised_conditions.hpp"
#include "methods/kkt/kkt_system.hpp"

namespace dmocbench {

/// The matrix of linearised conditions, which must outlive it.
[[nodiscard]] inline kkt::KktMatrix kkt_matrix_of(const LinearisedConditions& at) {
  return {at.hessian, at.jacobian, at.diagonal, at.compliance};
}

/// A way to solve with such a matrix: by intervals where the program's structure allows it, since that takes time
/// linear in their number, otherwise as below.
[[nodiscard]] std::unique_ptr<kkt::KktSystem> kkt_system_of(const NonlinearProgram& program);
/// By a sparse factorisation, whatever the point is: rounding of the multipliers may hide that it is a minimum.
[[nodiscard]] std::unique_ptr<kkt::KktSystem> kkt_system_of_any_point(const NonlinearProgram& program);

}  // namespace dmocbench
