// Instances that cannot be solved, or not even be begun, among others that can: what is wrong with one is said of it
// alone.

#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/mechanics/parameter_scope.hpp"
#include "methods/solvers/batch/solve_batch.hpp"
#include "methods/transcription/lane_transcription.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench::batch {
namespace {

/// DMOCBENCH_TEST_INSTANCES instances, 1,024 unless it is set.
std::size_t instance_count() {
  const char* given = std::getenv("DMOCBENCH_TEST_INSTANCES");
  return given == nullptr ? 1024 : std::stoul(given);
}

/// Swing-ups of carts with bobs of different masses to different places, the force and the rail bounded.
class SwingUps {
 public:
  SwingUps() : problem_(make_problem("cart_pole")) {
    program_ = std::make_unique<Transcription>(*problem_, *make_element("dmoc"), make_tableau("gauss", 1),
                                               Grid::uniform(8), OpenParameters{{"bob_mass"}});
    start_ = sample(*program_, guessed_motion(*problem_));
  }

  /// An instance whose cart goes to `place`, with a bob of `mass`.
  [[nodiscard]] BatchInstance instance(double place, double mass) const {
    BatchInstance made{.start = start_,
                       .equality_values = program_->constraint_lower(),
                       .multipliers = {},
                       .parameters = parameters(mass)};
    BoundaryState last = problem_->final_state();
    last.q[0] = place;
    ClampedEnds(*program_).write(problem_->initial_state(), last, made.start, made.equality_values);
    return made;
  }
  [[nodiscard]] std::vector<BatchInstance> instances(std::size_t count) const {
    tests::RandomPoints random;
    std::vector<BatchInstance> made(count);
    for (BatchInstance& one : made) one = instance(random.number(0.95, 1.05), random.number(0.28, 0.32));
    return made;
  }
  [[nodiscard]] Eigen::VectorXd parameters(double mass, const std::string& other = "bob_mass") const {
    Eigen::VectorXd values = parameter_values(*problem_);
    values[static_cast<Eigen::Index>(parameter_number(*problem_, other))] = mass;
    return values;
  }
  [[nodiscard]] std::size_t rows() const { return program_->constraint_count(); }

  [[nodiscard]] std::vector<Solution> solve(const std::vector<BatchInstance>& instances, std::size_t threads) {
    std::vector<Solution> solutions(instances.size());
    BatchOptions options{.threads = threads};
    options.set_parameters = parameters_of(*program_);
    const auto next = [&](std::size_t index, BatchInstance& instance) {
      if (index < instances.size()) instance = instances[index];
      return index < instances.size();
    };
    const auto take = [&](std::size_t index, const Solution& solution) { solutions[index] = solution; };
    EXPECT_EQ(solve_batch(*program_, lanes_of(*program_), start_, next, take, options).instances, instances.size());
    return solutions;
  }

 private:
  std::unique_ptr<Problem> problem_;
  std::unique_ptr<Transcription> program_;
  Eigen::VectorXd start_;
};

/// Something that is wrong with an instance, and what its answer has to be.
struct Poison {
  std::string name;
  BatchInstance instance;
  std::optional<Status> status;  ///< none: anything but solved
};

std::vector<Poison> poisons(const SwingUps& carts) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const BatchInstance healthy = carts.instance(1.0, 0.3);
  const auto with = [&](const auto& spoil) {
    BatchInstance spoilt = healthy;
    spoil(spoilt);
    return spoilt;
  };
  using Spoilt = BatchInstance&;
  const auto rows = static_cast<Eigen::Index>(carts.rows());
  return {{"a number of its start", with([](Spoilt i) { i.start[3] = nan; }), Status::evaluation_failed},
          {"a parameter that is no number", with([](Spoilt i) { i.parameters[1] = nan; }), Status::evaluation_failed},
          {"an infinite value of a row",
           with([](Spoilt i) { i.equality_values[0] = std::numeric_limits<double>::infinity(); }),
           Status::evaluation_failed},
          {"a multiplier", with([&](Spoilt i) { i.multipliers.setConstant(rows, nan); }), Status::evaluation_failed},
          {"the size of its start", with([](Spoilt i) { i.start.conservativeResize(3); }), Status::invalid_program},
          {"the size of its rows", with([](Spoilt i) { i.equality_values.setZero(1); }), Status::invalid_program},
          {"the size of its multipliers", with([](Spoilt i) { i.multipliers.setOnes(2); }), Status::invalid_program},
          {"the size of its parameters", with([](Spoilt i) { i.parameters.setOnes(1); }), Status::invalid_program},
          {"a parameter that changes bounds", with([&](Spoilt i) { i.parameters = carts.parameters(0.0, "bounded"); }),
           Status::invalid_program},
          {"a parameter that overflows", with([&](Spoilt i) { i.parameters = carts.parameters(1e308); }), std::nullopt},
          {"an end beyond the rail", carts.instance(9.0, 0.3), Status::infeasible}};
}

TEST(PoisonedBatch, ChangesNoDigitOfTheAnswersOfOthersAndSaysWhatIsWrong) {
  constexpr std::size_t one_percent = 93;  // the first of eight lanes, the fifth, the second, ...
  SwingUps carts;
  const std::vector<BatchInstance> healthy = carts.instances(instance_count());
  const std::vector<Poison> kinds = poisons(carts);
  std::vector<BatchInstance> mixed = healthy;
  std::map<std::size_t, const Poison*> poisoned;
  for (std::size_t i = 0; i < mixed.size(); i += one_percent) {
    poisoned[i] = &kinds[poisoned.size() % kinds.size()];
    mixed[i] = poisoned[i]->instance;
  }
  ASSERT_GE(poisoned.size(), kinds.size());
  const std::vector<Solution> expected = carts.solve(healthy, 1);
  const std::vector<Solution> found = carts.solve(mixed, 3);
  std::size_t solved = 0;
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    if (poisoned.contains(i)) {
      const Poison& poison = *poisoned[i];
      EXPECT_FALSE(is_solved(found[i].status)) << poison.name;
      EXPECT_FALSE(found[i].message.empty()) << poison.name;
      if (poison.status) {
        EXPECT_EQ(found[i].status, *poison.status) << poison.name << ": " << found[i].message;
      }
      continue;
    }
    EXPECT_EQ(found[i].status, expected[i].status) << i;
    EXPECT_EQ(found[i].solver, expected[i].solver) << i;
    EXPECT_EQ(found[i].major_iterations, expected[i].major_iterations) << i;
    EXPECT_EQ(found[i].objective, expected[i].objective) << i;
    EXPECT_EQ(found[i].primal, expected[i].primal) << i;
    EXPECT_EQ(found[i].multipliers, expected[i].multipliers) << i;
    solved += is_solved(found[i].status) ? 1 : 0;
  }
  EXPECT_GT(solved, mixed.size() * 9 / 10);
}

}  // namespace
}  // namespace dmocbench::batch
