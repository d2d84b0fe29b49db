// Claims about minima and about the whole library, on doctored tables.
#include <string>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "bench/claims/claim.hpp"
#include "bench/claims/predicates.hpp"

namespace dmocbench {
namespace {

/// The verdict on a claim by its whole id.
ClaimVerdict verdict_of_claim(const ResultTables& results, const std::string& id) {
  for (const Claim& judged : judge_claims(results)) {
    if (judged.id == id) return judged.verdict;
  }
  ADD_FAILURE() << "no claim " << id;
  return ClaimVerdict::not_yet;
}

TEST(LibraryClaims, LocalMinimaNeedTwoThatMoreThanOneMethodFinds) {
  const auto verdict = [](double second_by_tangent) {
    Table minima({"problem"});
    for (const auto& [objective, dmoc, tangent] :
         {std::tuple(80.0, 3.0, 2.0), std::tuple(90.0, 4.0, second_by_tangent), std::tuple(100.0, 1.0, 0.0)}) {
      Row row;
      row.set("problem", "two_link_manipulator");
      row.set("objective", objective);
      row.set("dmoc", dmoc);
      row.set("tangent", tangent);
      minima.append(row);
    }
    ResultTables results;
    results.add("local_minima_minima", minima);
    return verdict_of_claim(results, "two_link_manipulator/local_minima");
  };
  EXPECT_EQ(verdict(1.0), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict(0.0), ClaimVerdict::differs);
}

TEST(LibraryClaims, OneMethodFindsTheBestMinimumMoreOftenOnlyIfTheIntervalsAreApart) {
  const auto verdict = [](double lower, double upper) {
    Table shares({"problem"});
    for (const auto& [method, low, high] : {std::tuple("dmoc", 0.2, 0.4), std::tuple("tangent", lower, upper)}) {
      Row row;
      row.set("problem", "two_link_manipulator");
      row.set("method", method);
      row.set("share_lower", low);
      row.set("share_upper", high);
      shares.append(row);
    }
    ResultTables results;
    results.add("local_minima_shares", shares);
    return verdict_of_claim(results, "two_link_manipulator/best_minimum_share");
  };
  EXPECT_EQ(verdict(0.3, 0.6), ClaimVerdict::differs);
  EXPECT_EQ(verdict(0.5, 0.8), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict(0.05, 0.15), ClaimVerdict::reproduced);
}

TEST(LibraryClaims, TheLibraryIsJudgedByWhoIsBestMostOften) {
  const auto verdict = [](double dmoc, double hamiltonian) {
    Table summary({"method"});
    for (const auto& [method, wins] : {std::pair("dmoc", dmoc), std::pair("hamiltonian", hamiltonian)}) {
      Row row;
      row.set("method", method);
      row.set("wins_seconds", wins);
      summary.append(row);
    }
    ResultTables results;
    results.add("profile_summary", summary);
    return verdict_of_claim(results, "library/dmoc_best_by_seconds");
  };
  EXPECT_EQ(verdict(30.0, 20.0), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict(20.0, 20.0), ClaimVerdict::differs);
}

}  // namespace
}  // namespace dmocbench
