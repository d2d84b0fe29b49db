#pragma once

#include <Eigen/Core>

#include "methods/transcription/transcription.hpp"
#include "tests/support/dense_kkt.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench::tests {

/// A system of a program near a start, with a Hessian that is shifted to be definite.
inline KktNumbers shifted_system(Transcription& program, const Eigen::VectorXd& start) {
  RandomPoints random;
  const auto m = static_cast<Eigen::Index>(program.constraint_count());
  KktNumbers numbers;
  numbers.hessian.resize(static_cast<Eigen::Index>(program.hessian_structure().size()));
  numbers.jacobian.resize(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  const Eigen::VectorXd x = start + random.vector(start.size(), -1e-2, 1e-2);
  program.hessian(x, 1.0, random.vector(m, -1e-2, 1e-2), numbers.hessian);
  program.jacobian(x, numbers.jacobian);
  numbers.diagonal = random.vector(start.size(), 10.0, 11.0);
  numbers.compliance = random.vector(m, 0.1, 1.0);
  for (Eigen::Index i = 0; i < m; ++i) {
    if (program.constraint_lower()[i] == program.constraint_upper()[i]) numbers.compliance[i] = 0.0;
  }
  numbers.gradient = random.vector(start.size());
  numbers.rows = random.vector(m);
  return numbers;
}

}  // namespace dmocbench::tests
