#include "methods/transcription/transcription.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::RandomPoints;
using tests::Scheme;

/// Rows and cost of a chain of single intervals, each a program of its own on its own stretch of time, added up.
/// A single interval never fills a block of the tape, many do.
class IntervalByInterval {
 public:
  IntervalByInterval(const Transcription& whole, const Eigen::VectorXd& x) : whole_(whole), x_(x) {}

  [[nodiscard]] Eigen::VectorXd rows() const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(whole_.constraint_count()));
    const LocalVector& local = whole_.functions().rows;
    visit(local.schedule, [&](std::size_t k, std::size_t e, double value) {
      sum[static_cast<Eigen::Index>(whole_.blocks().row_places()[local.places[e]].at(k))] += value;
    });
    return sum;
  }
  [[nodiscard]] double cost() const {
    double sum = 0.0;
    visit(whole_.functions().cost, [&](std::size_t, std::size_t, double value) { sum += value; });
    return sum;
  }

 private:
  template <class Visitor>
  void visit(const Schedule& schedule, const Visitor& visitor) const {
    const LocalInputs& numbers = whole_.functions().inputs;
    const Tape tape(schedule);
    Tape::Workspace workspace(tape);
    for (std::size_t k = 0; k < whole_.blocks().intervals(); ++k) {
      std::vector<double> point(numbers.count());
      for (std::size_t a = 0; a < numbers.unknowns; ++a) {
        point[a] = x_[static_cast<Eigen::Index>(whole_.blocks().unknown_places()[a].at(k))];
      }
      point[numbers.step()] = whole_.step_inputs()[static_cast<Eigen::Index>(k)];
      point[numbers.time()] = whole_.time_inputs()[static_cast<Eigen::Index>(k)];
      std::vector<Tape::Input> inputs;
      inputs.reserve(point.size());
      for (const double& entry : point) inputs.push_back({&entry, false});
      std::vector<double> values(tape.output_count());
      std::vector<double*> outputs;
      outputs.reserve(values.size());
      for (double& value : values) outputs.push_back(&value);
      tape.evaluate(1, inputs, outputs, workspace);
      for (std::size_t e = 0; e < values.size(); ++e) visitor(k, e, values[e]);
    }
  }
  const Transcription& whole_;
  const Eigen::VectorXd& x_;
};

TEST(Transcription, EvaluatesPartialBlocksLikeSingleIntervals) {
  const auto problem = make_problem("two_link_manipulator");
  for (const Scheme& scheme : {Scheme{"dmoc", 2}, Scheme{"hamiltonian", 1}, Scheme{"tangent", 2}}) {
    for (int intervals = scheme.stages == 1 ? 2 : 1; intervals <= 70; ++intervals) {
      const auto program = tests::transcribe(*problem, scheme, Grid::uniform(intervals));
      const Eigen::VectorXd x = RandomPoints().vector(static_cast<Eigen::Index>(program->variable_count()));
      Eigen::VectorXd rows(static_cast<Eigen::Index>(program->constraint_count()));
      program->constraints(x, rows);
      const IntervalByInterval reference(*program, x);
      const Eigen::VectorXd expected = reference.rows();
      const double scale = expected.lpNorm<Eigen::Infinity>();
      ASSERT_LT((rows - expected).lpNorm<Eigen::Infinity>(), 1e-15 * scale * 4.0)
          << scheme.label() << ", N = " << intervals;
      ASSERT_NEAR(program->objective(x), reference.cost(), 1e-13 * std::abs(reference.cost()));
    }
  }
}

TEST(Transcription, RefusesTooFewIntervalsAndNamesTheSmallestNumber) {
  // s m N controls have to meet 2n end conditions: N >= 2n / (s m).
  struct Case {
    std::string problem;
    int stages;
    int smallest;
  };
  for (const Case& c : {Case{"orbital_transfer", 1, 4}, Case{"orbital_transfer", 2, 2}, Case{"orbital_transfer", 3, 2},
                        Case{"two_link_manipulator", 1, 2}}) {
    const auto problem = make_problem(c.problem);
    for (const std::string& method : paper_families()) {
      const Scheme scheme{method, c.stages};
      tests::expect_error_naming({c.problem, method, "at least " + std::to_string(c.smallest)},
                                 [&] { tests::transcribe(*problem, scheme, Grid::uniform(c.smallest - 1)); });
      const auto program = tests::transcribe(*problem, scheme, Grid::uniform(c.smallest));
      EXPECT_GE(free_variable_count(*program), program->constraint_count());
    }
  }
}

TEST(Transcription, RefusesAProblemWithoutControlsAndNamesNoNumberOfIntervals) {
  class Adrift final : public tests::SmallProblem {
   public:
    Adrift() : SmallProblem("adrift", at(0.0, 0.0), at(1.0, 0.0), 1.0, 0) {}
    [[nodiscard]] ExpressionVector force(const ControlledState&) const override { return one(0.0); }
    [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.v[0] * x.v[0]; }
  };
  tests::expect_error_naming({"adrift", "no free control"}, [] {
    tests::transcribe(Adrift(), {"dmoc", 1}, Grid::uniform(8));
  });
}

TEST(Transcription, FixesTheEndsByBoundsAndLeavesEverythingElseFree) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    const BoundaryState first = problem->initial_state();
    const BoundaryState last = problem->final_state();
    for (const Scheme& scheme : tests::all_schemes()) {
      const auto program = tests::transcribe(*problem, scheme, Grid::uniform(5));
      const auto n = static_cast<std::size_t>(problem->configuration_size());
      const std::size_t ends = (scheme.method == "dmoc" ? 2 : 4) * n;
      EXPECT_EQ(program->variable_count() - free_variable_count(*program), ends);
      for (std::size_t j = 0; j < program->variable_count(); ++j) {
        const auto i = static_cast<Eigen::Index>(j);
        if (program->variable_lower()[i] == program->variable_upper()[i]) continue;
        EXPECT_EQ(program->variable_lower()[i], -unbounded);
        EXPECT_EQ(program->variable_upper()[i], unbounded);
      }
      if (scheme.method != "tangent") continue;
      for (Eigen::Index i = 0; i < problem->configuration_size(); ++i) {
        const auto head = program->blocks().unknown(Quantity::second).index(i);
        EXPECT_EQ(program->variable_lower()[head], first.v[i]);
        EXPECT_EQ(program->variable_lower()[head + 5], last.v[i]);
      }
    }
  }
}

TEST(Transcription, MeasuresTimeFromZeroToTheHorizon) {
  const auto problem = make_problem("orbital_transfer");
  const auto program = tests::transcribe(*problem, {"dmoc", 1}, tests::graded_grid(9));
  const Eigen::VectorXd x = sample(*program, guessed_motion(*problem));
  const Eigen::VectorXd times = program->node_times(x);
  EXPECT_EQ(times[0], 0.0);
  EXPECT_EQ(times[9], problem->horizon());
  EXPECT_LT((program->steps(x) - (times.tail(9) - times.head(9))).lpNorm<Eigen::Infinity>(), 1e-14);
}

/// Overrides one answer of the double integrator with a wrong one.
class Ill final : public tests::SmallProblem {
 public:
  enum class Kind { none, horizon, short_state, infinite_state };
  Ill(Kind kind)
      : SmallProblem("ill", at(0.0, 0.0), at(1.0, 0.0), kind == Kind::horizon ? -1.0 : 1.0, 1), kind_(kind) {}
  [[nodiscard]] BoundaryState final_state() const override {
    BoundaryState last = SmallProblem::final_state();
    if (kind_ == Kind::short_state) last.v.resize(0);
    if (kind_ == Kind::infinite_state) last.v[0] = std::numeric_limits<double>::infinity();
    return last;
  }

 private:
  Kind kind_;
};

TEST(Transcription, RefusesIllPosedProblemsAndSaysWhy) {
  const auto transcribe = [](Ill::Kind kind) {
    return [kind] { tests::transcribe(Ill(kind), {"dmoc", 1}, Grid::uniform(8)); };
  };
  EXPECT_NO_THROW(transcribe(Ill::Kind::none)());
  tests::expect_error_naming({"ill", "horizon"}, transcribe(Ill::Kind::horizon));
  tests::expect_error_naming({"ill", "boundary state", "0", "1"}, transcribe(Ill::Kind::short_state));
  tests::expect_error_naming({"ill", "boundary state", "finite"}, transcribe(Ill::Kind::infinite_state));
}

TEST(Transcription, RoundingFloorGrowsWithTheNumberOfIntervals) {
  const auto problem = make_problem("orbital_transfer");
  const auto floor = [&](int intervals) {
    return tests::transcribe(*problem, {"dmoc", 1}, Grid::uniform(intervals))->rounding_floors().largest;
  };
  EXPECT_GT(floor(64), 0.0);
  EXPECT_NEAR(floor(128), 2.0 * floor(64), 1e-12 * floor(64));
  EXPECT_LT(floor(1024), 1e-10);
}

TEST(Transcription, RoundingFloorsBelongToTheStepsOfTheirOwnRows) {
  const auto problem = make_problem("orbital_transfer");
  const double even = tests::transcribe(*problem, {"dmoc", 1}, Grid::uniform(16))->rounding_floors().largest;
  for (const std::string& method : paper_families()) {
    for (const int stages : {1, 2}) {
      const auto program = tests::transcribe(*problem, {method, stages}, tests::grid_with_a_narrow_interval());
      const RoundingFloors& floors = program->rounding_floors();
      ASSERT_FALSE(floors.are_equal());
      const auto expect = [&](const Places& places, const Eigen::VectorXd& values, double of_border) {
        ASSERT_EQ(static_cast<std::size_t>(values.size()), places.size());
        Eigen::Index i = 0;
        places.for_each([&](const Place& place) {
          const bool is_border = place.kind == Place::Kind::border;
          const bool is_narrow = place.index == 8 || (place.kind == Place::Kind::node && place.index == 9);
          const double expected = is_border ? of_border : is_narrow ? even / 16.0 * 1e7 : even;
          EXPECT_NEAR(values[i++] / expected, 1.0, 1e-5) << method << " " << stages << ", place " << place.index;
        });
      };
      expect(program->blocks().structure().rows, floors.constraints, floors.smallest);
      expect(program->blocks().structure().unknowns, floors.variables, floors.largest);
    }
  }
}

TEST(Transcription, RoundingFloorsOfVariablesDoNotVanishWithSmallConfigurations) {
  // Jᵀλ sums products of λ with L_vv / h, here exactly 1 / h, however low the beam lies.
  const auto beam = make_problem("beam");
  beam->set_parameter("bound", 0.001);
  const auto program = tests::transcribe(*beam, {"dmoc", 1}, Grid::uniform(1024));
  const RoundingFloors& floors = program->rounding_floors();
  constexpr double entry = 1024.0;
  for (const double floor : floors.variables) EXPECT_GE(floor, std::numeric_limits<double>::epsilon() * entry);
  for (const double floor : floors.constraints) EXPECT_LT(floor, 0.01 * floors.largest);
}

}  // namespace
}  // namespace dmocbench
