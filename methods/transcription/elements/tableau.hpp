#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace dmocbench {

/// A Butcher tableau (A, b, c) and its conjugate Ã, which makes the pair symplectic (eq:DMOC_RK_symp):
/// b_i ã_ij + b_j a_ji = b_i b_j. Configurations use A, momenta Ã.
struct Tableau {
  std::string family;           ///< "gauss", "lobatto" or "lobatto_shared"
  Eigen::MatrixXd a;            ///< A, s × s
  Eigen::MatrixXd a_conjugate;  ///< Ã, s × s
  Eigen::VectorXd b;            ///< weights, s entries, all > 0
  Eigen::VectorXd c;            ///< stage times relative to the interval, s entries in [0, 1]
  int order = 0;                ///< classical order of the pair
  /// The last stage of an interval and the first of the next, which are the same time, have one control: possible where
  /// c_1 = 0 and c_s = 1. Otherwise every stage has its own.
  bool shares_controls = false;

  [[nodiscard]] Eigen::Index stages() const noexcept { return b.size(); }  ///< s.
  /// True if the stages of both are at the same times.
  [[nodiscard]] bool has_times_of(const Tableau& other) const { return c.size() == other.c.size() && c == other.c; }
};

/// The coefficients that form a symplectic pair with the given ones: ã_ij = b_j - b_j a_ji / b_i (eq:DMOC_RK_symp), s ×
/// s for s weights b, none of them 0. Applied twice, it returns the given coefficients.
template <class Scalar>
[[nodiscard]] Eigen::MatrixX<Scalar> conjugate_coefficients(const Eigen::MatrixX<Scalar>& a,
                                                            const Eigen::VectorX<Scalar>& b) {
  Eigen::MatrixX<Scalar> conjugate(a.rows(), a.cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < a.cols(); ++j) conjugate(i, j) = b[j] - b[j] * a(j, i) / b[i];
  }
  return conjugate;
}

/// The collocation tableau whose stages are the given nodes (distinct, in [0, 1]):
/// a_ij = ∫₀^{c_i} ℓ_j, b_j = ∫₀¹ ℓ_j with ℓ_j the Lagrange polynomials; Ã is computed from (eq:DMOC_RK_symp).
/// Throws `Error` if nodes coincide or a weight is not positive.
[[nodiscard]] Tableau collocation_tableau(std::string family, const std::vector<long double>& nodes, int order);

/// The stage times of a Gauss tableau with any number of stages: the zeros of the Legendre polynomial of degree
/// `stages`, mapped from [-1, 1] to [0, 1], ascending.
[[nodiscard]] std::vector<long double> gauss_nodes(int stages);

/// Gauss-Legendre, order 2s. s = 1 is the midpoint rule.
[[nodiscard]] Tableau gauss_tableau(int stages);

/// Lobatto IIIA with Lobatto IIIB for the momenta, order 2s - 2, s >= 2: the ends of an interval are stages. With
/// `shares_controls`, tangent-space collocation by s = 2 is trapezoidal and by s = 3 Hermite-Simpson collocation.
[[nodiscard]] Tableau lobatto_tableau(int stages, bool shares_controls = false);

/// Names of the tableau families.
[[nodiscard]] std::vector<std::string> tableau_names();

/// The numbers of stages with which a family is offered. Throws `Error` if there is no such family.
[[nodiscard]] std::vector<int> tableau_stages(std::string_view family);

/// Throws `Error` that lists the choices if the family or the number of stages is unknown.
[[nodiscard]] Tableau make_tableau(std::string_view family, int stages);

/// The Lagrange polynomials ℓ_j of the nodes c at τ: ℓ_j(c_i) = δ_ij. As many entries as c, whose entries differ.
[[nodiscard]] inline Eigen::VectorXd lagrange_basis(const Eigen::VectorXd& c, double tau) {
  Eigen::VectorXd values = Eigen::VectorXd::Ones(c.size());
  for (Eigen::Index j = 0; j < c.size(); ++j) {
    for (Eigen::Index i = 0; i < c.size(); ++i) {
      if (i != j) values[j] *= (tau - c[i]) / (c[j] - c[i]);
    }
  }
  return values;
}

/// Every tableau, each family with each number of stages, except tableaus whose neighbouring intervals share controls:
/// on a single interval they are the same method as tableaus without shared controls.
[[nodiscard]] inline std::vector<Tableau> one_step_tableaus() {
  std::vector<Tableau> tableaus;
  for (const std::string& family : tableau_names()) {
    for (const int stages : tableau_stages(family)) {
      Tableau tableau = make_tableau(family, stages);
      if (!tableau.shares_controls) tableaus.push_back(std::move(tableau));
    }
  }
  return tableaus;
}

}  // namespace dmocbench
