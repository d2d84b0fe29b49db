// Rows of the two collocation families at arbitrary points against formulas written out here.

#include <gtest/gtest.h>

#include "problems/registry.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::RandomPoints;

/// The two-link arm with m = l = 1, J = 1/12, g = 9.81, by hand.
struct TwoLinkByHand {
  static constexpr double g = 9.81;
  static Eigen::Matrix2d mass(const Eigen::Vector2d& q) {
    const double c = 0.5 * std::cos(q[0] - q[1]);
    return (Eigen::Matrix2d() << 4.0 / 3.0, c, c, 1.0 / 3.0).finished();
  }
  static Eigen::Vector2d l_q(const Eigen::Vector2d& q, const Eigen::Vector2d& v) {
    const double s = 0.5 * std::sin(q[0] - q[1]) * v[0] * v[1];
    return {-s - 1.5 * g * std::cos(q[0]), s - 0.5 * g * std::cos(q[1])};
  }
  /// d/dt L_v = M v̇ + (Ṁ) v.
  static Eigen::Vector2d momentum_rate(const Eigen::Vector2d& q, const Eigen::Vector2d& v, const Eigen::Vector2d& a) {
    const double c_dot = -0.5 * std::sin(q[0] - q[1]) * (v[0] - v[1]);
    return mass(q) * a + Eigen::Vector2d(c_dot * v[1], c_dot * v[0]);
  }
  static Eigen::Vector2d force(const Eigen::Vector2d& u) { return {u[0] - u[1], u[1]}; }
};

/// Gauss is its own conjugate; only a pair like Lobatto IIIA-IIIB tells A from Ã.
Tableau tableau_named(const std::string& name) {
  if (name == "lobatto3") return collocation_tableau(name, {0.0L, 0.5L, 1.0L}, 4);
  return gauss_tableau(name.back() - '0');
}

class CollocationRows : public testing::TestWithParam<std::string> {
 protected:
  static constexpr Eigen::Index intervals = 4;

  void read(const std::string& method) {
    program_ =
        std::make_unique<Transcription>(*problem_, *make_element(method), tableau_, tests::graded_grid(intervals));
    x_ = RandomPoints(5).vector(static_cast<Eigen::Index>(program_->variable_count()), -2.0, 2.0);
    rows_.resize(static_cast<Eigen::Index>(program_->constraint_count()));
    program_->constraints(x_, rows_);
  }
  [[nodiscard]] Eigen::Vector2d at(std::size_t first, std::size_t second, Eigen::Index k) const {
    return {x_[static_cast<Eigen::Index>(first) + k], x_[static_cast<Eigen::Index>(second) + k]};
  }
  /// All s slopes of a column pair; the last follows from x_{k+1} = x_k + h Σ b_j K_j.
  template <class Slope>
  [[nodiscard]] std::vector<Eigen::Vector2d> slopes(const Eigen::Vector2d& left, const Eigen::Vector2d& right, double h,
                                                    const Slope& slope) const {
    const Eigen::Index s = tableau_.stages();
    std::vector<Eigen::Vector2d> all;
    Eigen::Vector2d rest = (right - left) / h;
    for (Eigen::Index j = 0; j + 1 < s; ++j) {
      all.push_back(slope(j));
      rest -= tableau_.b[j] * all.back();
    }
    all.emplace_back(rest / tableau_.b[s - 1]);
    return all;
  }
  [[nodiscard]] static Eigen::Vector2d stage(const Eigen::Vector2d& left, double h, Eigen::Index i,
                                             const Eigen::MatrixXd& a, const std::vector<Eigen::Vector2d>& k) {
    Eigen::Vector2d value = left;
    for (std::size_t j = 0; j < k.size(); ++j) value += h * a(i, static_cast<Eigen::Index>(j)) * k[j];
    return value;
  }
  /// Rows 2n of stage i of interval k: first the kinematic ones, then the dynamic ones.
  [[nodiscard]] Eigen::Vector2d row(Eigen::Index i, Eigen::Index part, Eigen::Index k) const {
    const Eigen::Index head = (4 * i + 2 * part) * intervals + k;
    return {rows_[head], rows_[head + intervals]};
  }
  /// Calls visitor(k, i, Q_i, Q̇_i, Y_i, Ẏ_i, U_i) with Y = P or V.
  template <class Visitor>
  void visit(const Eigen::MatrixXd& a_second, const Visitor& visitor) const {
    const ProgramBlocks& blocks = program_->blocks();
    for (Eigen::Index k = 0; k < intervals; ++k) {
      const double h = program_->step_inputs()[k];
      const auto q = [&](Eigen::Index node) {
        return at(blocks.unknown(Quantity::configuration).at(0), blocks.unknown(Quantity::configuration).at(1), node);
      };
      const auto y = [&](Eigen::Index node) {
        return at(blocks.unknown(Quantity::second).at(0), blocks.unknown(Quantity::second).at(1), node);
      };
      const auto q_slopes = slopes(q(k), q(k + 1), h, [&](Eigen::Index j) {
        return at(blocks.unknown(Quantity::rate, j).at(0), blocks.unknown(Quantity::rate, j).at(1), k);
      });
      const auto y_slopes = slopes(y(k), y(k + 1), h, [&](Eigen::Index j) {
        return at(blocks.unknown(Quantity::second_rate, j).at(0), blocks.unknown(Quantity::second_rate, j).at(1), k);
      });
      for (Eigen::Index i = 0; i < tableau_.stages(); ++i) {
        const auto stage_number = static_cast<std::size_t>(i);
        visitor(k, i, stage(q(k), h, i, tableau_.a, q_slopes), q_slopes[stage_number],
                stage(y(k), h, i, a_second, y_slopes), y_slopes[stage_number],
                at(blocks.unknown(Quantity::control, i).at(0), blocks.unknown(Quantity::control, i).at(1), k));
      }
    }
  }

  static constexpr double tolerance = 1e-11;  // slopes here are of size 100
  Tableau tableau_ = tableau_named(GetParam());
  std::unique_ptr<Problem> problem_ = make_problem("two_link_manipulator");
  std::unique_ptr<Transcription> program_;
  Eigen::VectorXd x_;
  Eigen::VectorXd rows_;
};

TEST_P(CollocationRows, OfTheHamiltonianFamilyAreLegendreAndForceBalance) {
  read("hamiltonian");
  visit(tableau_.a_conjugate, [&](Eigen::Index k, Eigen::Index i, const Eigen::Vector2d& q, const Eigen::Vector2d& v,
                                  const Eigen::Vector2d& p, const Eigen::Vector2d& p_dot, const Eigen::Vector2d& u) {
    const Eigen::Vector2d legendre = p - TwoLinkByHand::mass(q) * v;
    const Eigen::Vector2d balance = p_dot - TwoLinkByHand::l_q(q, v) - TwoLinkByHand::force(u);
    EXPECT_LT((row(i, 0, k) - legendre).norm(), tolerance * (1.0 + legendre.norm()));
    EXPECT_LT((row(i, 1, k) - balance).norm(), tolerance * (1.0 + balance.norm()));
  });
}

TEST_P(CollocationRows, OfTheTangentFamilyAreKinematicsAndEulerLagrange) {
  read("tangent");
  visit(tableau_.a, [&](Eigen::Index k, Eigen::Index i, const Eigen::Vector2d& q, const Eigen::Vector2d& q_dot,
                        const Eigen::Vector2d& v, const Eigen::Vector2d& v_dot, const Eigen::Vector2d& u) {
    const Eigen::Vector2d kinematics = q_dot - v;
    const Eigen::Vector2d balance =
        TwoLinkByHand::momentum_rate(q, v, v_dot) - TwoLinkByHand::l_q(q, v) - TwoLinkByHand::force(u);
    EXPECT_LT((row(i, 0, k) - kinematics).norm(), tolerance * (1.0 + kinematics.norm()));
    EXPECT_LT((row(i, 1, k) - balance).norm(), tolerance * (1.0 + balance.norm()));
  });
}

INSTANTIATE_TEST_SUITE_P(All, CollocationRows, testing::Values("gauss1", "gauss2", "gauss3", "lobatto3"),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace dmocbench
