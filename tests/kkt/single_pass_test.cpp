// The elimination in a single pass against dense linear algebra, on systems whose states are given at both ends.

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/registry.hpp"
#include "tests/support/dense_kkt.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench::kkt {
namespace {

struct PassCase {
  const char* problem;
  int links;  // of a chain
  int seeds;
};

/// Counts by what dense linear algebra says.
struct PassCounts {
  int minima = 0;
  int saddles = 0;
  int decided_by_the_pass = 0;
};

/// DMOC on horizons that are shorter than ν is carried, as long and longer, with negative curvature that is scattered
/// over the unknowns, so that about half of the systems have a minimum.
void compare_inertia(const PassCase& the_case, PassCounts& counts) {
  const auto problem = make_problem(the_case.problem);
  if (the_case.links > 0) problem->set_parameter("links", the_case.links);
  for (int seed = 0; seed < the_case.seeds; ++seed) {
    const Eigen::Index intervals = 4 + seed % 20;
    SCOPED_TRACE(problem->name() + ", N = " + std::to_string(intervals) + ", seed " + std::to_string(seed));
    std::mt19937 generator(static_cast<unsigned>(seed));
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Transcription program(*problem, *make_element("dmoc"), tests::Scheme{"dmoc", 1}.tableau(),
                          Grid::uniform(intervals));
    tests::KktNumbers numbers = tests::shifted_system(program, sample(program, guessed_motion(*problem)));
    numbers.hessian.setZero();
    const double lowest = -0.8 * uniform(generator);
    for (double& entry : numbers.diagonal) entry = lowest + 1.0 + uniform(generator);
    const tests::DenseKkt dense(program, numbers);
    const tests::DenseKkt::Inertia inertia = dense.inertia();
    if (!(inertia.rank > 1e-9) || std::abs(inertia.smallest) < 1e-8 * inertia.largest) continue;
    const auto kkt = IntervalKkt::make(program).value();
    Eigen::VectorXd primal(numbers.gradient.size());
    Eigen::VectorXd multipliers(numbers.rows.size());
    const FactorisationStatus status =
        kkt->solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers});
    const bool is_minimum = inertia.smallest > 0.0;
    EXPECT_EQ(status, is_minimum ? FactorisationStatus::solved : FactorisationStatus::wrong_inertia);
    ++(is_minimum ? counts.minima : counts.saddles);
    if (kkt->eliminations() == 1) ++counts.decided_by_the_pass;
    if (!is_minimum || status != FactorisationStatus::solved) continue;
    const Eigen::VectorXd wanted = dense.solution();
    const Eigen::Index n = primal.size();
    const double rounding =
        1e-9 + 10.0 * static_cast<double>(wanted.size()) * std::numeric_limits<double>::epsilon() * dense.condition();
    EXPECT_LT((primal - wanted.head(n)).lpNorm<Eigen::Infinity>(), rounding * wanted.lpNorm<Eigen::Infinity>());
    EXPECT_LT((multipliers - wanted.tail(wanted.size() - n)).lpNorm<Eigen::Infinity>(),
              rounding * wanted.lpNorm<Eigen::Infinity>());
  }
}

TEST(SinglePass, FindsTheInertiaAndTheStepOfDenseLinearAlgebra) {
  PassCounts counts;
  for (const PassCase& the_case : {PassCase{"orbital_transfer", 0, 300},
                                   {"two_link_manipulator", 0, 300},
                                   {"link_chain", 3, 100},
                                   {"link_chain", 4, 100},
                                   {"link_chain", 5, 50},
                                   {"link_chain", 6, 50},
                                   {"link_chain", 8, 30}}) {
    compare_inertia(the_case, counts);
  }
  const int systems = counts.minima + counts.saddles;
  EXPECT_GT(counts.minima, 200);
  EXPECT_GT(counts.saddles, 200);
  EXPECT_GT(counts.decided_by_the_pass, systems * 2 / 3) << systems << " systems, " << counts.minima << " minima";
}

}  // namespace
}  // namespace dmocbench::kkt
