// Mechanisms by their embedding q = Φ(θ): the solutions are those of multipliers, with fewer unknowns.
#include "methods/mechanics/embedded_problem.hpp"

#include <concepts>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "methods/mechanics/legendre_transform.hpp"
#include "problems/cart_pole_cartesian.hpp"
#include "problems/link_chain_maximal.hpp"
#include "problems/satellite_directors.hpp"
#include "problems/satellite_quaternion.hpp"
#include "problems/spherical_pendulum_cartesian.hpp"
#include "problems/two_link_maximal.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Answer;
using tests::Scheme;

constexpr Eigen::Index intervals = 64;

Answer solved(const Problem& problem, const Scheme& scheme) {
  return tests::confirmed(problem, scheme, intervals, guessed_motion(problem), 1e-9);
}

/// A satellite turns about no axis of its own.
template <class Redundant>
std::shared_ptr<const Problem> mechanism() {
  auto problem = std::make_shared<Redundant>();
  if constexpr (std::derived_from<Redundant, SatelliteSlew>) {
    for (const auto& [name, value] : {std::pair("axis_2", 0.7), {"axis_3", -0.4}, {"angle", 2.6}}) {
      problem->set_parameter(name, value);
    }
  }
  return problem;
}

template <class Redundant>
class EmbeddedProblemOf : public testing::Test {
 protected:
  [[nodiscard]] BoundaryState lifted(const Trajectory& motion, Eigen::Index k, const Eigen::VectorXd& rate) const {
    return embedded.lifted(BoundaryState{.q = motion.q.row(k), .v = rate}, motion.node_times[k]);
  }
  std::shared_ptr<const Problem> redundant = mechanism<Redundant>();
  EmbeddedProblem embedded{redundant};
};

using Mechanisms = testing::Types<SphericalPendulumCartesian, CartPoleCartesian, TwoLinkMaximal, LinkChainMaximal,
                                  SatelliteDirectors, SatelliteQuaternion>;
TYPED_TEST_SUITE(EmbeddedProblemOf, Mechanisms);

TYPED_TEST(EmbeddedProblemOf, HasTheSolutionsOfMultipliersByDmocAndByHamiltonianCollocation) {
  for (const char* method : {"dmoc", "hamiltonian"}) {
    const Trajectory by_multipliers = solved(*this->redundant, {method, 1}).motion;
    const Trajectory by_embedding = solved(this->embedded, {method, 1}).motion;
    double of_q = 0.0;
    for (Eigen::Index k = 0; k <= intervals; ++k) {
      const Eigen::VectorXd q = this->lifted(by_embedding, k, by_embedding.v.row(k)).q;
      of_q = std::max(of_q, (q - by_multipliers.q.row(k).transpose()).template lpNorm<Eigen::Infinity>());
    }
    EXPECT_LT(of_q, 1e-11 * by_multipliers.q.cwiseAbs().maxCoeff()) << method;
    const double of_u = (by_embedding.stage_u - by_multipliers.stage_u).template lpNorm<Eigen::Infinity>();
    EXPECT_LT(of_u, 1e-10 * by_multipliers.stage_u.cwiseAbs().maxCoeff()) << method;
    EXPECT_NEAR(by_embedding.cost, by_multipliers.cost, 1e-12 * by_multipliers.cost) << method;
  }
}

TYPED_TEST(EmbeddedProblemOf, HasTheMomentaOfMultipliersAlongTheManifold) {
  const Trajectory by_multipliers = solved(*this->redundant, {"dmoc", 1}).motion;
  const Trajectory by_embedding = solved(this->embedded, {"dmoc", 1}).motion;
  for (Eigen::Index k = 0; k <= intervals; k += 16) {
    const Eigen::Index freedoms = by_embedding.q.cols();
    const Eigen::VectorXd of_chart = this->lifted(by_embedding, k, Eigen::VectorXd::Zero(freedoms)).v;
    for (Eigen::Index i = 0; i < freedoms; ++i) {
      const Eigen::VectorXd along = this->lifted(by_embedding, k, Eigen::VectorXd::Unit(freedoms, i)).v - of_chart;
      EXPECT_NEAR(by_embedding.p(k, i), by_multipliers.p.row(k).dot(along),
                  1e-10 * by_multipliers.p.cwiseAbs().maxCoeff());
    }
  }
}

TYPED_TEST(EmbeddedProblemOf, HasAsManyUnknownsAndRowsPerNodeAsDegreesOfFreedom) {
  const auto program = tests::transcribe(this->embedded, {"dmoc", 1}, Grid::uniform(intervals));
  const Eigen::Index freedoms = this->embedded.configuration_size();
  const Eigen::Index controls = this->embedded.control_size() * intervals;
  EXPECT_EQ(program->variable_count(), static_cast<std::size_t>((intervals + 1) * freedoms + controls));
  EXPECT_EQ(program->constraint_count(), static_cast<std::size_t>((intervals + 1) * freedoms));
}

/// A pendulum with an embedding that may be wrong.
class PendulumByRod final : public tests::SmallProblem {
 public:
  using Embedding = ExpressionVector (*)(const Expression& theta);
  explicit PendulumByRod(Embedding of_rod, bool has_wall = false)
      : SmallProblem("pendulum_by_rod", BoundaryState::at_rest(Eigen::Vector2d(0.0, -1.0)),
                     BoundaryState::at_rest(Eigen::Vector2d(1.0, 0.0)), 2.0, 1),
        embedding_(of_rod),
        has_wall_(has_wall) {}
  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    return ExpressionVector{{q.dot(q) - 1.0}};
  }
  [[nodiscard]] ExpressionVector embedding(const ExpressionVector& theta) const override {
    return embedding_(theta[0]);
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v.dot(x.v) - x.q[1]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{-x.u[0] * x.q[1], x.u[0] * x.q[0]}};
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    if (has_wall_) bounds.q = Bounds::all(2, -2.0, 2.0);
    return bounds;
  }

 private:
  Embedding embedding_;
  bool has_wall_;
};

ExpressionVector on_circle(const Expression& theta) { return ExpressionVector{{sin(theta), -cos(theta)}}; }

std::string refusal(PendulumByRod::Embedding embedding, bool has_wall = false) {
  return tests::sentence_of_error(
      [&] { static_cast<void>(EmbeddedProblem(std::make_shared<const PendulumByRod>(embedding, has_wall))); });
}

TEST(EmbeddedProblemRefuses, ThatLeaveTheConstraints) {
  const std::string sentence = refusal([](const Expression& theta) { return ExpressionVector{{sin(theta), theta}}; });
  EXPECT_PRED2(tests::says, sentence, "pendulum_by_rod: embedding(theta) violates constraints[0]: g = ");
  EXPECT_PRED2(tests::says, sentence, ", but must be 0");
}

TEST(EmbeddedProblemRefuses, ThatMissAnEnd) {
  // One quarter of the circle.
  const std::string sentence = refusal([](const Expression& theta) {
    const Expression x = theta / sqrt(1.0 + theta * theta);
    return ExpressionVector{{x * x, sqrt(1.0 - x * x * x * x)}};
  });
  EXPECT_PRED2(tests::says, sentence, "pendulum_by_rod: embedding(theta) does not reach initial_state: ");
}

TEST(EmbeddedProblemRefuses, OfAnotherSizeOrNone) {
  EXPECT_EQ(refusal([](const Expression& theta) { return ExpressionVector{{theta}}; }),
            "pendulum_by_rod: embedding has 1 entry, expected 2");
  EXPECT_EQ(refusal([](const Expression&) { return ExpressionVector(); }),
            "pendulum_by_rod does not define embedding(theta); define it or use multipliers");
}

TEST(EmbeddedProblemRefuses, BoundsOnCoordinatesThatAreNotItsOwn) {
  EXPECT_EQ(
      refusal(on_circle, true),
      "pendulum_by_rod: an embedding supports bounds between the ends only on coordinates that are entries of theta; "
      "use multipliers");
}

TEST(EmbeddedProblemRefuses, OtherMethodsAndTableaus) {
  const EmbeddedProblem problem(std::make_shared<const PendulumByRod>(on_circle));
  for (const Scheme& scheme : {Scheme{"tangent", 1}, Scheme{"dmoc", 2, "lobatto"}, Scheme{"hamiltonian", 2},
                               Scheme{"multiple_shooting_rk4_1", 1}}) {
    EXPECT_EQ(
        tests::sentence_of_error([&] { static_cast<void>(tests::transcribe(problem, scheme, Grid::uniform(8))); }),
        "the embedding of constraints is supported only by dmoc and hamiltonian with --tableau gauss --stages 1");
  }
}

}  // namespace
}  // namespace dmocbench
