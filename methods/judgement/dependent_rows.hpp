#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// Whether a value is at a finite bound, up to 1e-6 of its size.
[[nodiscard]] bool is_held(double value, double bound);

/// Constraints whose gradients depend on each other at a point, up to rounding: Σ y_i ∇a_i = 0 over the variables whose
/// bounds differ, with y largest at the first row and at least a tenth of that at the others. Equalities count, and
/// inequalities that are held there. One row means that its derivatives vanish. If there are several dependencies it is
/// one of them. Empty if there is none, or if a number is not finite.
///
/// `point` has variable_count() entries. It takes one sparse factorisation, and throws `Stopped` as that does.
[[nodiscard]] std::vector<std::size_t> dependent_rows(NonlinearProgram& program, const Eigen::VectorXd& point);

}  // namespace dmocbench
