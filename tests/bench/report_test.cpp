#include <string>

#include <gtest/gtest.h>

#include "bench/report/figure_markup.hpp"
#include "bench/report/html.hpp"
#include "bench/report/page.hpp"
#include "bench/report/reached_optima.hpp"
#include "problems/registry.hpp"

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
  EXPECT_TRUE(has(page, "<th scope=\"col\">objective <small>[cost]</small>"));
  EXPECT_TRUE(has(page, "<dt>objective<dd>of the trajectory"));
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
  results.motions.push_back({"</script>", "<dmoc>", Table::from_csv("t,</script>_x,</script>_y\n0,1,0\n1,0,1\n")});
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
  EXPECT_TRUE(has(page, "id='f0-gpPt0'") && has(page, "href='#f0-gpPt0'"));
  EXPECT_TRUE(has(page, "id='f1-gpPt0'") && has(page, "href='#f1-gpPt0'"));
  EXPECT_FALSE(has(page, "<g"));
  EXPECT_FALSE(has(page, "<?xml") || has(page, "Gnuplot"));
}

TEST(Report, LeavesOutOfFiguresWhatDoesNotShow) {
  const std::string svg = figure_markup(
      "<svg ><defs><path id='gpPt0' d='M-1,0 h2'/><use id='gpPt1' href='#gpPt0'/><circle id='gpDot' r='0.5'/></defs>\n"
      "<g id=\"a\"><g fill=\"none\">\n</g>\n</g>\n<path d='M93.47,455.01 L9.25,0.178'/><use href='#gpPt1'/>"
      "<text>slope 12.34</text></svg>",
      "f", "a figure");
  EXPECT_TRUE(has(svg, "d='M93.5,455 L9.25,0.178'"));
  EXPECT_TRUE(has(svg, "slope 12.34"));
  EXPECT_TRUE(has(svg, "id='fgpPt0'") && has(svg, "href='#fgpPt1'"));
  EXPECT_FALSE(has(svg, "gpDot") || has(svg, "<g"));
}

TEST(Report, MotionsHaveRodsWhereDistancesStay) {
  ResultsFolder results;
  results.motions.push_back(
      {"arm", "dmoc", Table::from_csv("t_[s],tip_x_[m],tip_y_[m],load_x_[m],load_y_[m]\n0,1,0,2,0\n1,0,1,0,5\n")});
  const std::string page = report_page(results, "");
  EXPECT_TRUE(has(page, R"("name":"tip","x":[1.0,0.0],"y":[0.0,1.0],"rod":true)"));
  EXPECT_TRUE(has(page, R"("name":"load","x":[2.0,0.0],"y":[0.0,5.0],"rod":false)"));
}

TEST(Report, DrawsOneMotionOfEachMethodAndQuantitiesWhereNothingMovesInThePlane) {
  ResultsFolder results;
  const Table plane = Table::from_csv("t_[s],x,y\n0,0,0\n1,1,1\n");
  for (const char* const method : {"dmoc", "tangent", "dmoc"}) results.motions.push_back({"arm", method, plane});
  results.motions.push_back({"spring", "dmoc", Table::from_csv("t_[s],q_[m]\n0,1\n1,3\n")});
  const std::string page = report_page(results, "");
  EXPECT_TRUE(has(page, "<polyline class=\"path method-1\""));
  EXPECT_FALSE(has(page, "<polyline class=\"path method-2\""));
  EXPECT_TRUE(has(page, "q_[m] from 1 to 3</text>"));
}

TEST(Report, TellsWhichMethodsReachTheOptimumOfAProblemAsItIsStated) {
  ResultsFolder results = folder_with(Table::from_csv(
      "problem,method,status,objective\narm,dmoc,solved,1.001\narm,dmoc,solved,2\narm,dmoc,iteration limit,1\n"
      "arm,tangent,solved,3\nleg,dmoc,solved,1\n"));
  const std::vector<ReachedOptimum> methods = reached_optima(results, "arm", 1.0);
  ASSERT_EQ(methods.size(), 2U);
  EXPECT_EQ(methods[0].rows, 3U);
  EXPECT_EQ(methods[0].solved, 2U);
  EXPECT_EQ(methods[0].near, 1U);
  EXPECT_NEAR(methods[0].smallest_difference.value(), 0.001, 1e-12);
  EXPECT_EQ(methods[1].near, 0U);
  EXPECT_EQ(lowest_cost(results, "arm").value(), 1.001);
  results.runs.front().metadata["command_line"] = {"objective", "--set", "mass=2"};
  EXPECT_TRUE(reached_optima(results, "arm", 1.0).empty());
}

TEST(Report, StatesEveryProblemOfTheLibraryBesideItsMotion) {
  ResultsFolder results;
  results.motions.push_back({"hang_glider", "dmoc", Table::from_csv("t_[s],x_[m],y_[m]\n0,0,9\n1,1,8\n")});
  const std::string page = report_page(results, "");
  for (const std::string& name : problem_names()) {
    EXPECT_TRUE(has(page, "<article id=\"" + anchor("problem", name) + "\">")) << name;
  }
  EXPECT_TRUE(has(page, "-1247.987601, 10 digits"));
  EXPECT_TRUE(has(page, "<p>Minimise <math><mrow><mi>Φ</mi></mrow></math></p>"));
}

}  // namespace
}  // namespace dmocbench
