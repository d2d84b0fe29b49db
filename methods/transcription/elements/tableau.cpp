#include "methods/transcription/elements/tableau.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <ranges>
#include <utility>

#include <Eigen/LU>
#include <boost/math/special_functions/legendre.hpp>
#include <boost/math/tools/roots.hpp>

#include "methods/choose.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

using LongMatrix = Eigen::MatrixX<long double>;
using LongVector = Eigen::VectorX<long double>;

constexpr int most_stages = 4;
constexpr int fewest_lobatto_stages = 2;

/// 0, 1 and the zeros of the derivative of the Legendre polynomial of degree `stages` - 1, which lie between the
/// zeros of the polynomial itself; mapped from [-1, 1] to [0, 1].
std::vector<long double> lobatto_nodes(int stages) {
  std::vector<long double> nodes{0.0L};
  const std::vector<long double> zeros = gauss_nodes(stages - 1);
  const auto derivative = [&](long double c) { return boost::math::legendre_p_prime(stages - 1, 2.0L * c - 1.0L); };
  for (std::size_t i = 0; i + 1 < zeros.size(); ++i) {
    constexpr int bits = std::numeric_limits<long double>::digits;
    std::uintmax_t most_steps = 100;
    const auto bracket = boost::math::tools::toms748_solve(
        derivative, zeros[i], zeros[i + 1], boost::math::tools::eps_tolerance<long double>(bits), most_steps);
    nodes.push_back(std::midpoint(bracket.first, bracket.second));
  }
  nodes.push_back(1.0L);
  return nodes;
}

struct Family {
  std::string_view name;
  int fewest_stages;
  Tableau (*make)(int stages);
};

// One line per family.
constexpr auto families = std::to_array<Family>({
    {"gauss", 1, gauss_tableau},
    {"lobatto", fewest_lobatto_stages, [](int stages) { return lobatto_tableau(stages, false); }},
    {"lobatto_shared", fewest_lobatto_stages, [](int stages) { return lobatto_tableau(stages, true); }},
});

constexpr auto tableau_name = [](const Family& family) { return family.name; };

}  // namespace

std::vector<long double> gauss_nodes(int stages) {
  const auto positive = boost::math::legendre_p_zeros<long double>(stages);  // the zeros >= 0, ascending
  std::vector<long double> nodes;
  for (const long double zero : positive | std::views::reverse) {
    if (zero > 0.0L) nodes.push_back((1.0L - zero) / 2.0L);
  }
  for (const long double zero : positive) nodes.push_back((1.0L + zero) / 2.0L);
  return nodes;
}

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
  Tableau tableau;
  tableau.family = std::move(family);
  tableau.a = a.cast<double>();
  tableau.a_conjugate = conjugate_coefficients(a, b).cast<double>();
  tableau.b = b.cast<double>();
  tableau.c = Eigen::Map<const LongVector>(nodes.data(), s).cast<double>();
  tableau.order = order;
  return tableau;
}

Tableau gauss_tableau(int stages) {
  if (stages < 1 || stages > most_stages) {
    throw Error("gauss supports 1 to {} stages, got {}", most_stages, stages);
  }
  return collocation_tableau("gauss", gauss_nodes(stages), 2 * stages);
}

Tableau lobatto_tableau(int stages, bool shares_controls) {
  if (stages < fewest_lobatto_stages || stages > most_stages) {
    throw Error("lobatto supports {} to {} stages, got {}", fewest_lobatto_stages, most_stages, stages);
  }
  Tableau tableau =
      collocation_tableau(shares_controls ? "lobatto_shared" : "lobatto", lobatto_nodes(stages), 2 * stages - 2);
  tableau.shares_controls = shares_controls;
  return tableau;
}

std::vector<std::string> tableau_names() { return names_of(families, tableau_name); }

std::vector<int> tableau_stages(std::string_view family) {
  std::vector<int> stages;
  const int fewest = one_of(families, tableau_name, family, "there is no tableau").fewest_stages;
  for (int s = fewest; s <= most_stages; ++s) stages.push_back(s);
  return stages;
}

Tableau make_tableau(std::string_view family, int stages) {
  return one_of(families, tableau_name, family, "there is no tableau").make(stages);
}

}  // namespace dmocbench
