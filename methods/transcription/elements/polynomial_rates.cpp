#include "methods/transcription/elements/polynomial_rates.hpp"

namespace dmocbench {

Eigen::MatrixXd integrals_to(const Eigen::VectorXd& c, const Tableau& stages) {
  Eigen::MatrixXd integrals = Eigen::MatrixXd::Zero(c.size(), stages.stages());
  for (Eigen::Index i = 0; i < c.size(); ++i) {
    for (Eigen::Index j = 0; j < stages.stages(); ++j) {
      integrals.row(i) += c[i] * stages.b[j] * lagrange_basis(stages.c, c[i] * stages.c[j]).transpose();
    }
  }
  return integrals;
}

Eigen::MatrixXd derivatives_at(const Eigen::VectorXd& c, const Tableau& stages) {
  const Eigen::Index s = stages.stages();
  Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(c.size(), s);
  for (Eigen::Index i = 0; i < c.size(); ++i) {
    for (Eigen::Index left_out = 0; left_out < s; ++left_out) {
      for (Eigen::Index j = 0; j < s; ++j) {
        if (j == left_out) continue;
        double product = 1.0 / (stages.c[j] - stages.c[left_out]);
        for (Eigen::Index k = 0; k < s; ++k) {
          if (k != j && k != left_out) product *= (c[i] - stages.c[k]) / (stages.c[j] - stages.c[k]);
        }
        derivatives(i, j) += product;
      }
    }
  }
  return derivatives;
}

}  // namespace dmocbench
