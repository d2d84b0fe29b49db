#include "methods/numerics/lagrange_basis.hpp"

namespace dmocbench {

Eigen::VectorXd lagrange_basis(const Eigen::VectorXd& c, double tau) {
  Eigen::VectorXd values = Eigen::VectorXd::Ones(c.size());
  for (Eigen::Index j = 0; j < c.size(); ++j) {
    for (Eigen::Index i = 0; i < c.size(); ++i) {
      if (i != j) values[j] *= (tau - c[i]) / (c[j] - c[i]);
    }
  }
  return values;
}

}  // namespace dmocbench
