#include <string>

#include <gtest/gtest.h>

#include "bench/report/html.hpp"
#include "bench/report/page.hpp"

namespace dmocbench {
namespace {

using Json = nlohmann::ordered_json;

Table two_solves() {
  return Table::from_csv(
      "problem,method,status,intervals,objective,note\n"
      "arm,dmoc,solved,16,0.12345678901234567,same\narm,dmoc,iteration limit,32,,same\n");
}

ResultsFolder folder_with(Table table) {
  ResultsFolder results;
  results.runs.push_back({"objective", Json{{"command_line", {"objective", "--out", "x"}}, {"complete", true}}});
  results.runs.back().metadata["tables"]["objective.csv"]["meanings"]["objective"] = "[cost] of the trajectory";
  results.tables.push_back({"objective.csv", "objective", std::move(table)});
  return results;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Html, ShowsLettersThatMeanSomethingToItAsLetters) {
  EXPECT_EQ(escaped("<a href=\"x\">&</a>"), "&lt;a href=&quot;x&quot;&gt;&amp;&lt;/a&gt;");
  EXPECT_EQ(escaped("q̇ ≤ 1 🚀"), "q̇ ≤ 1 🚀");
  EXPECT_EQ(escaped("\xff|\xc3"), "?|?");
}

TEST(Html, LinksHaveNoLetterThatEndsThem) {
  EXPECT_EQ(anchor("claim", "two_link/state_slope"), "claim-two-link-state-slope");
  EXPECT_EQ(anchor("table", "\"><script>"), "table----script-");
}

TEST(Html, ShortensNumbersAndLeavesTexts) {
  EXPECT_EQ(shortened("0.12345678901234567"), "0.123457");
  EXPECT_EQ(shortened("16"), "16");
  EXPECT_EQ(shortened("iteration limit"), "iteration limit");
}

TEST(Report, MarksRowsThatWereNotSolvedAndTellsWhatAllRowsShare) {
  const std::string page = report_page(folder_with(two_solves()), "");
  EXPECT_TRUE(has(page, "<tr class=\"unsolved\"><td>iteration limit"));
  EXPECT_TRUE(has(page, "<tr><td>solved<td>16<td>0.123457"));
  EXPECT_TRUE(has(page, "In all rows problem = arm, method = dmoc, note = same</p>"));
  EXPECT_TRUE(has(page, "title=\"[cost] of the trajectory\">objective"));
  EXPECT_TRUE(has(page, "<code>objective --out x</code>"));
}

TEST(Report, SaysOfARunThatItIsNotComplete) {
  ResultsFolder results = folder_with(two_solves());
  EXPECT_FALSE(has(report_page(results, ""), "is not complete"));
  results.runs.front().metadata["complete"] = false;
  EXPECT_TRUE(has(report_page(results, ""), "The run objective is not complete."));
}

TEST(Report, RunsNothingThatStandsInATable) {
  ResultsFolder results = folder_with(Table::from_csv("problem,<img>\n<script>alert(1)</script>,</table>\nb,c\n"));
  results.claims = Table::from_csv("claim,verdict,whose,states\n<b>/x,</summary>,\"\"\"><i>\",<script>\n");
  results.motions.push_back({"</script>", "dmoc", Table::from_csv("t,</script>_x,</script>_y\n0,1,0\n1,0,1\n")});
  const std::string page = report_page(results, "");
  EXPECT_FALSE(has(page, "<script>alert"));
  EXPECT_FALSE(has(page, "<img>"));
  EXPECT_FALSE(has(page, "<b>/x"));
  EXPECT_FALSE(has(page, "\"name\":\"</script>"));
}

TEST(Report, FiguresShareNoNames) {
  ResultsFolder results;
  const std::string svg =
      "<?xml version=\"1.0\"?>\n<svg ><title>Gnuplot</title><g id=\"gnuplot_plot_1\" ><title>a</title></g><path "
      "id='gpPt0'/><use xlink:href='#gpPt0'/></svg>\n";
  results.figures = {{"one", svg}, {"two", svg}};
  const std::string page = report_page(results, "");
  EXPECT_TRUE(has(page, "id='s-one-gpPt0'") && has(page, "href='#s-one-gpPt0'"));
  EXPECT_TRUE(has(page, "id='s-two-gpPt0'") && has(page, "href='#s-two-gpPt0'"));
  EXPECT_TRUE(has(page, "<g ></g><path "));
  EXPECT_FALSE(has(page, "<?xml") || has(page, "Gnuplot"));
}

TEST(Report, MotionsHaveRodsWhereDistancesStay) {
  ResultsFolder results;
  results.motions.push_back(
      {"arm", "dmoc", Table::from_csv("t_in_s,tip_x_in_m,tip_y_in_m,load_x_in_m,load_y_in_m\n0,1,0,2,0\n1,0,1,0,5\n")});
  const std::string page = report_page(results, "");
  EXPECT_TRUE(has(page, R"("name":"tip","x":[1.0,0.0],"y":[0.0,1.0],"rod":true)"));
  EXPECT_TRUE(has(page, R"("name":"load","x":[2.0,0.0],"y":[0.0,5.0],"rod":false)"));
}

}  // namespace
}  // namespace dmocbench
