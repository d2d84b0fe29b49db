// The written table of claims: whose statement stands where, and what its closing lines count.
#include "bench/claims/claims_table.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "bench/run/result_file.hpp"
#include "methods/error.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dmocbench {
namespace {

JudgedClaim claim_of(const char* problem, const char* name, Whose whose, ClaimVerdict verdict) {
  return {.problem = problem,
          .name = name,
          .where = "section 4",
          .figure = "fig:any",
          .whose = whose,
          .states = "|J| falls",
          .clauses = {{.text = "it falls, by \"2\"", .numbers = {{"ratio", 2.0, "dmoc", "N = 8", "m"}}},
                      {.text = "1 of 3 left out"}},
          .verdict = verdict,
          .reasons = {{.text = "of the step"}},
          .evidence = {"convergence.csv", "figures/orbit_state_error.svg"},
          .sure = "exact"};
}

TEST(ReadRows, AreThoseWhoseNumbersWereRead) {
  Table table = Table::from_csv("method,error,cost\ndmoc,1,7\ntangent,2,7\ndmoc,3,7\n\"other, record\",4,7\n");
  table.name_places("errors.csv");
  Table texts = Table::from_csv("verdict\nslope\n");
  texts.name_places("slopes.csv");
  const ReadFields fields;
  double sum = 0.0;
  for (const Row& row : table.rows()) {
    if (row.text("method") == "dmoc") sum += row.needed("error");
  }
  EXPECT_EQ(sum, 4.0);
  EXPECT_EQ(texts.rows().front().text("verdict"), "slope");
  const std::vector<ReadRows> read = read_rows(fields);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].table, "errors.csv");
  EXPECT_EQ(read[0].records, (std::vector<std::size_t>{2, 4}));
  EXPECT_EQ(read[0].columns, (std::vector<std::string>{"error", "method"}));
  EXPECT_EQ(read[1].records, (std::vector<std::size_t>{2}));
}

TEST(ReadRows, AreNotThoseOfAnInnerJudgement) {
  Table table = Table::from_csv("error\n1\n");
  table.name_places("errors.csv");
  const ReadFields outer;
  {
    const ReadFields inner;
    EXPECT_EQ(table.rows().front().number("error", 0.0), 1.0);
    EXPECT_EQ(inner.rows().size(), 1U);
  }
  EXPECT_TRUE(outer.rows().empty());
}

TEST(ReadRows, AreWrittenAsRanges) {
  EXPECT_EQ(packed_ranges({2, 3, 4, 9, 11, 12}), "2-4 9 11-12");
  EXPECT_EQ(packed_ranges({}), "");
  JudgedClaim claim = claim_of("a", "one", Whose::paper, ClaimVerdict::reproduced);
  claim.rows = {{"errors.csv", {2, 3}, {"error", "method"}}};
  EXPECT_EQ(claims_rows_table({claim}).csv(), "claim,table,records,columns\na/one,errors.csv,2-3,error method\n");
}

using ClaimsFolder = tests::InTemporaryFolder;

TEST_F(ClaimsFolder, LacksEvidenceThatTheRowNames) {
  std::vector<JudgedClaim> claims{claim_of("a", "one", Whose::paper, ClaimVerdict::reproduced)};
  claims.front().evidence = {"misprints.csv", "figures/orbit.svg"};
  write_file(folder() / "misprints.csv", "a\n");
  mark_missing_evidence(claims, folder());
  EXPECT_EQ(claims.front().missing, std::vector<std::string>{"figures/orbit.svg"});
  EXPECT_EQ(claims_table(claims).rows().front().text("evidence"), "misprints.csv; figures/orbit.svg (missing)");
}

const std::vector<JudgedClaim> some{claim_of("a", "one", Whose::paper, ClaimVerdict::reproduced),
                                    claim_of("b", "two", Whose::ours, ClaimVerdict::differs),
                                    claim_of("c", "three", Whose::paper, ClaimVerdict::differs),
                                    claim_of("d", "four", Whose::misprint, ClaimVerdict::differs),
                                    claim_of("e", "five", Whose::paper, ClaimVerdict::differs)};

TEST(ClaimsTable, IsReadBackWithEveryField) {
  const Table table = Table::from_csv(claims_table(some).csv());
  EXPECT_EQ(table.columns(), (std::vector<std::string>{"claim", "where", "figure", "whose", "states", "measured",
                                                       "verdict", "reason", "evidence", "sure"}));
  ASSERT_EQ(table.rows().size(), some.size());
  EXPECT_EQ(table.rows()[1].text("whose"), "ours");
  EXPECT_EQ(table.rows()[1].text("verdict"), "differs");
  EXPECT_EQ(table.rows()[1].text("measured"), "it falls, by \"2\"; 1 of 3 left out");
}

TEST(ClaimsTable, HasItsFactsAsValuesForPrograms) {
  std::vector<JudgedClaim> claims = some;
  claims.front().rows = {{"errors.csv", {2, 3}, {"error"}}};
  const nlohmann::ordered_json json = claims_json(claims).at("claims");
  ASSERT_EQ(json.size(), some.size());
  const nlohmann::ordered_json& claim = json.front();
  EXPECT_EQ(claim.at("problem"), "a");
  EXPECT_EQ(claim.at("name"), "one");
  ASSERT_EQ(claim.at("measured").size(), 2U);
  const nlohmann::ordered_json number{
      {"name", "ratio"}, {"value", 2.0}, {"method", "dmoc"}, {"at", "N = 8"}, {"unit", "m"}};
  EXPECT_EQ(claim.at("measured").front().at("numbers"), nlohmann::ordered_json::array({number}));
  EXPECT_EQ(claim.at("measured").back().at("text"), "1 of 3 left out");
  EXPECT_EQ(claim.at("figures"), nlohmann::ordered_json::array({"orbit_state_error"}));
  EXPECT_EQ(claim.at("rows").front().at("records"), nlohmann::ordered_json::array({2, 3}));
}

TEST(Words, CarryTheNumbersThatTheyState) {
  const Words slope = worded("{} {:.1f}", "dmoc", Measurement{"slope", 1.96, "dmoc"});
  const Words all = worded("slopes {}, expected {:g}", joined({slope, {}, slope}, "; "), Measurement{"order", 2.0});
  EXPECT_EQ(all.text, "slopes dmoc 2.0; dmoc 2.0, expected 2");
  ASSERT_EQ(all.numbers.size(), 3U);
  EXPECT_EQ(all.numbers[1].value, 1.96);
  EXPECT_EQ(all.numbers[2].name, "order");
  EXPECT_TRUE(all.are_finite());
  EXPECT_FALSE(worded("{}", listed("{:.2f}", {{"ratio", 1.0}, {"ratio", std::numeric_limits<double>::infinity()}}))
                   .are_finite());
}

TEST(ClaimsTable, CountsThePapersStatementsApartFromOursAndFromMisprints) {
  EXPECT_EQ(closing_lines(some), (std::vector<std::string>{"the paper's statements and remarks: 1 reproduced, 2 differ",
                                                           "our findings: 1 differs", "misprints: 1 differs"}));
}

TEST(ClaimsTable, CountsThePapersStatementsBySection) {
  std::vector<JudgedClaim> claims = some;
  claims[2].where = "sections 2.2 and 3.4, equ_L_RK";
  claims[4].where = "section 2.2";
  EXPECT_EQ(section_lines(claims), (std::vector<std::string>{"section 2.2: 2 differ", "section 4: 1 reproduced"}));
  EXPECT_EQ(section_in("th:pontryagin, below"), "th:pontryagin");
}

TEST(ClaimsTable, HasATableForEachSourceAndNoBarThatWouldBeginAColumn) {
  const std::string text = claims_markdown(some);
  const auto place = [&](const char* part) { return text.find(part); };
  EXPECT_LT(place("## The paper's statements and remarks\n"), text.rfind("a/one"));
  EXPECT_LT(text.rfind("e/five"), place("## Our findings"));
  EXPECT_LT(text.rfind("b/two"), place("## Misprints"));
  EXPECT_LT(place("## Misprints"), text.rfind("d/four"));
  EXPECT_EQ(place("## Extensions"), std::string::npos);
  EXPECT_NE(place("\\|J\\| falls"), std::string::npos);
}

TEST(ClaimsTable, BeginsWithWhatThePaperStatesAndIsNotReproducedAndWithOurHeadlines) {
  std::vector<JudgedClaim> claims = some;
  claims[1].headline = true;
  const std::string text = claims_markdown(claims);
  const std::string summary = text.substr(0, text.find("## The paper's statements and remarks\n"));
  EXPECT_PRED2(tests::says, summary, "- **c/three** (section 4), differs: |J| falls. Measured: it falls");
  EXPECT_PRED2(tests::says, summary, "- **b/two**");
  EXPECT_EQ(summary.find("a/one"), std::string::npos) << summary;
  EXPECT_EQ(summary.find("d/four"), std::string::npos) << summary;
}

TEST(ClaimsTable, TellsWhichRequiredClaimsAreNotReproduced) {
  EXPECT_TRUE(not_reproduced(some, {"a/one"}).empty());
  const std::vector<std::string> missed = not_reproduced(some, {"a/one", "c/three"});
  ASSERT_EQ(missed.size(), 1U);
  EXPECT_TRUE(missed.front().starts_with("c/three is not reproduced but differs")) << missed.front();
  EXPECT_THROW(static_cast<void>(not_reproduced(some, {"no/claim"})), Error);
}

}  // namespace
}  // namespace dmocbench
