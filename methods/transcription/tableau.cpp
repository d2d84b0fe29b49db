#include "methods/transcription/tableau.hpp"

#include <array>
#include <utility>

#include <Eigen/LU>
#include <boost/math/special_functions/legendre.hpp>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

constexpr int most_gauss_stages = 3;

/// The zeros of the Legendre polynomial of degree `stages`, carried from [-1, 1] to [0, 1].
std::vector<long double> gauss_nodes(int stages) {
  const auto positive = boost::math::legendre_p_zeros<long double>(stages);  // the zeros >= 0, ascending
  std::vector<long double> nodes;
  for (auto zero = positive.rbegin(); zero != positive.rend(); ++zero) {
    if (*zero > 0.0L) nodes.push_back((1.0L - *zero) / 2.0L);
  }
  for (const long double zero : positive) nodes.push_back((1.0L + zero) / 2.0L);
  return nodes;
}

}  // namespace

Tableau collocation_tableau(std::string family, const std::vector<long double>& nodes, int order) {
  const auto s = static_cast<Eigen::Index>(nodes.size());
  // Exact integration of 1, τ, ..., τ^{s-1}: Σ_j a_ij c_j^{q-1} = c_i^q / q, and the same for b with upper limit 1.
  LongMatrix powers(s, s);
  LongMatrix integrals(s, s + 1);
  for (Eigen::Index q = 0; q < s; ++q) {
    for (Eigen::Index j = 0; j < s; ++j) {
      const long double c = nodes[static_cast<std::size_t>(j)];
      powers(q, j) = std::pow(c, static_cast<long double>(q));
      integrals(q, j) = std::pow(c, static_cast<long double>(q + 1)) / static_cast<long double>(q + 1);
    }
    integrals(q, s) = 1.0L / static_cast<long double>(q + 1);
  }
  const Eigen::FullPivLU<LongMatrix> solver(powers);
  if (!solver.isInvertible()) throw Error("the nodes of a tableau must be distinct");
  const LongMatrix solution = solver.solve(integrals);  // column i: row i of A; last column: b
  const LongMatrix a = solution.leftCols(s).transpose();
  const LongVector b = solution.col(s);
  if ((b.array() <= 0.0L).any()) throw Error("the weights of a tableau must be positive");
  LongMatrix conjugate(s, s);
  for (Eigen::Index i = 0; i < s; ++i) {
    for (Eigen::Index j = 0; j < s; ++j) conjugate(i, j) = b[j] - b[j] * a(j, i) / b[i];
  }
  Tableau tableau;
  tableau.family = std::move(family);
  tableau.a = a.cast<double>();
  tableau.a_conjugate = conjugate.cast<double>();
  tableau.b = b.cast<double>();
  tableau.c = Eigen::Map<const LongVector>(nodes.data(), s).cast<double>();
  tableau.order = order;
  return tableau;
}

Tableau gauss_tableau(int stages) {
  if (stages < 1 || stages > most_gauss_stages) {
    throw Error("gauss has 1 to " + std::to_string(most_gauss_stages) + " stages, got " + std::to_string(stages));
  }
  return collocation_tableau("gauss", gauss_nodes(stages), 2 * stages);
}

std::vector<std::string> tableau_names() { return {"gauss"}; }

std::vector<int> tableau_stages(std::string_view family) {
  if (family == "gauss") return {1, 2, 3};
  throw Error("there is no tableau \"" + std::string(family) + "\"; choose one of gauss");
}

Tableau make_tableau(std::string_view family, int stages) {
  static_cast<void>(tableau_stages(family));
  return gauss_tableau(stages);
}

}  // namespace dmocbench
