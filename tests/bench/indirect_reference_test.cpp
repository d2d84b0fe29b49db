#include "bench/run/indirect_reference.hpp"

#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/run/result_file.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dmocbench {
namespace {

/// The double integrator under the same name and parameters, but with another formula.
class HeavierIntegrator final : public tests::SmallProblem {
 public:
  HeavierIntegrator() : SmallProblem("double_integrator", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return x.v[0] * x.v[0]; }
};

Trajectory direct_solution(const Problem& problem) {
  return tests::solve(problem, {"dmoc", 2}, Grid::uniform(64), tests::common_start(problem)).trajectory;
}

class IndirectReferenceIn : public tests::InTemporaryFolder {
 protected:
  /// The row of the one problem asked for.
  Row row_for(const Problem& problem, const Trajectory& direct) {
    IndirectReference reference(folder());
    static_cast<void>(reference.near(problem, direct));
    EXPECT_EQ(reference.table().rows().size(), 1U);
    return reference.table().rows().front();
  }
  static bool was_solved(const Row& row) { return row.number("seconds").has_value(); }

  tests::DoubleIntegrator problem_;
  Trajectory direct_ = direct_solution(problem_);
};

TEST_F(IndirectReferenceIn, AFolderIsSolvedOnceAndReadWithAllDigits) {
  const Row first = row_for(problem_, direct_);
  const Row second = row_for(problem_, direct_);
  EXPECT_TRUE(was_solved(first));
  EXPECT_FALSE(was_solved(second));
  for (const std::string column : {"cost", "certified_digits", "replay_error", "psi_q_q1", "psi_p_q1"}) {
    EXPECT_EQ(first.text(column), second.text(column)) << column;
  }
  EXPECT_NEAR(second.needed("cost"), 6.0, 1e-12);
  EXPECT_NEAR(*second.number("psi_q_q1"), -12.0, 1e-11);
  EXPECT_NEAR(*second.number("psi_p_q1"), -6.0, 1e-11);
}

TEST_F(IndirectReferenceIn, AFolderIsNotUsedForAChangedFormula) {
  static_cast<void>(row_for(problem_, direct_));
  const HeavierIntegrator changed;
  const Row row = row_for(changed, direct_solution(changed));
  EXPECT_TRUE(was_solved(row));
  EXPECT_NEAR(row.needed("cost"), 24.0, 1e-11);
}

TEST_F(IndirectReferenceIn, AFolderIsNotUsedForOtherParameters) {
  const auto orbit = make_problem("orbital_transfer");
  static_cast<void>(row_for(*orbit, direct_solution(*orbit)));
  EXPECT_FALSE(was_solved(row_for(*orbit, direct_solution(*orbit))));
  // Only a unit: the equations stay, the key does not.
  orbit->set_parameter("gravitational_parameter", 398601.0);
  EXPECT_TRUE(was_solved(row_for(*orbit, direct_solution(*orbit))));
}

TEST_F(IndirectReferenceIn, AFolderIsNotUsedForAnotherBranch) {
  static_cast<void>(row_for(problem_, direct_));
  Trajectory elsewhere = direct_;
  elsewhere.q.array() += 0.2;
  // There is no other branch to find: the answer is refused instead of being taken for it.
  tests::expect_error_naming({"different branch"}, [&] { static_cast<void>(row_for(problem_, elsewhere)); });
  IndirectReference reference(folder());
  static_cast<void>(reference.near(problem_, direct_));
  tests::expect_error_naming({"different branch"}, [&] { static_cast<void>(reference.near(problem_, elsewhere)); });
}

TEST_F(IndirectReferenceIn, ADamagedFileIsWrittenAnew) {
  static_cast<void>(row_for(problem_, direct_));
  const std::filesystem::path file = folder() / "double_integrator_indirect.json";
  const std::string good = read_file(file);
  for (const std::string& damaged : {good.substr(0, good.size() / 2), std::string("[]"), std::string()}) {
    write_file(file, damaged);
    EXPECT_TRUE(was_solved(row_for(problem_, direct_)));
    EXPECT_FALSE(was_solved(row_for(problem_, direct_)));
  }
}

TEST_F(IndirectReferenceIn, AFolderInThePlaceOfTheFileIsNoHindrance) {
  std::filesystem::create_directories(folder() / "double_integrator_indirect.json" / "inner");
  IndirectReference reference(folder());
  EXPECT_NEAR(reference.near(problem_, direct_).cost(), 6.0, 1e-12);
  ASSERT_EQ(reference.notes().size(), 1U);
  EXPECT_NE(reference.notes().front().find("double_integrator_indirect.json"), std::string::npos);
}

TEST_F(IndirectReferenceIn, AFileWithAnotherCostOrAgreementIsWrittenAnew) {
  static_cast<void>(row_for(problem_, direct_));
  const std::filesystem::path file = folder() / "double_integrator_indirect.json";
  const auto good = nlohmann::ordered_json::parse(read_file(file));
  for (const char* const number : {"/scaled_cost", "/agreement/state", "/agreement/cost"}) {
    auto damaged = good;
    auto& value = damaged[nlohmann::ordered_json::json_pointer(number)];
    value = 1.01 * value.get<double>() + 1e-3;
    write_file(file, damaged.dump());
    EXPECT_TRUE(was_solved(row_for(problem_, direct_))) << number;
  }
}

TEST_F(IndirectReferenceIn, MetadataTellTheInitialCostate) {
  IndirectReference reference(folder());
  static_cast<void>(reference.near(problem_, direct_));
  const auto metadata = reference.metadata();
  ASSERT_EQ(metadata.size(), 1U);
  EXPECT_EQ(metadata[0]["problem"], "double_integrator");
  EXPECT_GE(metadata[0]["certified_digits"].get<double>(), 11.0);
  EXPECT_NEAR(metadata[0]["initial_costate"]["psi_q_q1"].get<double>(), -12.0, 1e-11);
}

}  // namespace
}  // namespace dmocbench
