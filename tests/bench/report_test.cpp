#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/report/compared_tables.hpp"
#include "bench/report/comparison_page.hpp"
#include "bench/report/html.hpp"
#include "bench/report/page.hpp"
#include "bench/report/reached_optima.hpp"
#include "bench/run/result_file.hpp"
#include "problems/registry.hpp"
#include "tests/support/temporary_folder.hpp"

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

TEST(Html, KeepsNumbersWithAnExponentOnOneLine) {
  EXPECT_EQ(escaped_prose("to -3.5e-13 & 2e-9; the-end, e-7, 1e5"),
            "to <span class=\"number\">-3.5e-13</span> &amp; <span class=\"number\">2e-9</span>; the-end, e-7, 1e5");
  EXPECT_EQ(escaped_prose("1e-"), "1e-");
  EXPECT_EQ(escaped_prose(""), "");
}

TEST(Html, LinksHaveNoLetterThatEndsThem) {
  EXPECT_EQ(anchor("claim", "two_link/state_slope"), "claim-two-link-state-slope");
  EXPECT_EQ(anchor("table", "\"><script>"), "table----script-");
}

TEST(Html, WritesBytesInTheLettersOfBase64) {  // the examples of RFC 4648
  const std::vector<std::pair<std::string, std::string>> examples{{"", ""},
                                                                  {"f", "Zg=="},
                                                                  {"fo", "Zm8="},
                                                                  {"foo", "Zm9v"},
                                                                  {"foob", "Zm9vYg=="},
                                                                  {"fooba", "Zm9vYmE="},
                                                                  {"foobar", "Zm9vYmFy"},
                                                                  {"\xfb\xff\xfe", "+//+"}};
  for (const auto& [bytes, letters] : examples) EXPECT_EQ(base64(bytes), letters);
}

TEST(Html, ShortensNumbersAndLeavesTexts) {
  EXPECT_EQ(shortened("0.12345678901234567"), "0.123457");
  EXPECT_EQ(shortened("16"), "16");
  EXPECT_EQ(shortened("iteration limit"), "iteration limit");
}

TEST(Html, NamesMethodsAsFiguresDo) {
  EXPECT_EQ(method_in_words("dmoc"), "DMOC");
  EXPECT_EQ(method_in_words("multiple_shooting_rk4_1"), "Multiple shooting, rk4, 1 step");
  EXPECT_EQ(method_in_words("single_shooting_midpoint_2"), "Single shooting, midpoint, 2 steps");
  EXPECT_EQ(method_in_words("my_own"), "my own");
}

/// Claims of the paper and of the suite, and two figures, one of which a claim of the paper names.
ResultsFolder judged_folder() {
  ResultsFolder results = folder_with(two_solves());
  results.claims = Table::from_csv(
      "claim,where,whose,states,measured,verdict,evidence\n"
      "orbital_transfer/equal_solutions,\"section 3.4, th:equi\",paper,same,1e-13,reproduced,t.csv; "
      "figures/orbital_transfer_equal.svg\n"
      "orbital_transfer/ours,,ours,more,5,differs,t.csv\n");
  results.figures = {{"orbital_transfer_equal", "<svg/>"}, {"orbital_transfer_sweep", "<svg/>"}};
  return results;
}

TEST(Report, AnswersOnTheFirstScreenWithSectionVerdictAndFigure) {
  const std::string page = report_page(judged_folder(), "");
  const std::string overview = page.substr(0, page.find("</section>"));
  EXPECT_TRUE(has(overview, "<b>Accuracy</b> <i>(section 3.4)</i>"));
  EXPECT_TRUE(has(overview, "<span class=\"verdict v-reproduced\">reproduced</span>"));
  EXPECT_TRUE(has(overview, "<a class=\"small\" href=\"#figure-orbital-transfer-equal\">"));
  EXPECT_TRUE(has(overview, "<a href=\"#figures\">all figures</a>"));
  EXPECT_FALSE(has(overview, "#gallery"));
}

TEST(Report, PutsThePapersClaimsFirstAndClosesTheOthers) {
  const std::string page = report_page(judged_folder(), "");
  const std::size_t paper =
      page.find("<h3>The paper, section 3.4</h3>\n<details class=\"claim\" id=\"claim-orbital-transfer-equal");
  const std::size_t others = page.find("<details class=\"group\"><summary><b>ours</b> (1)</summary>");
  ASSERT_NE(paper, std::string::npos);
  ASSERT_NE(others, std::string::npos);
  EXPECT_LT(paper, others);
  EXPECT_GT(page.find("id=\"claim-orbital-transfer-ours\""), others);
}

TEST(Report, GroupsFiguresByThePapersSectionsThenByKind) {
  const std::string page = report_page(judged_folder(), "");
  EXPECT_TRUE(has(page, "<dt>The paper, section 3.4<dd><a href=\"#figure-orbital-transfer-equal\">"));
  EXPECT_TRUE(has(page, "<dt>sweep<dd><a href=\"#figure-orbital-transfer-sweep\">"));
  EXPECT_LT(page.find("<h3>The paper, section 3.4</h3>\n<figure"), page.find("<h3>sweep</h3>\n<figure"));
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

TEST(Report, TellsHowLongAllRunsTook) {
  ResultsFolder results = folder_with(two_solves());
  results.runs.push_back(results.runs.front());
  results.runs.front().metadata["utc_time"] = "2026-11-23T14:00:00Z";
  results.runs.back().metadata["utc_time"] = "2026-11-23T14:10:00Z";
  EXPECT_TRUE(has(report_page(results, ""), "the last at 2026-11-23T14:10:00Z, 10.0 minutes later\n"));
  results.runs.front().metadata["wall_seconds"] = 6000.0;  // it ends last
  results.runs.back().metadata["wall_seconds"] = 30.0;
  EXPECT_TRUE(has(report_page(results, ""), "; all had ended 100.0 minutes after the first began\n"));
  results.runs.pop_back();
  results.runs.front().metadata["wall_seconds"] = 2.5;
  EXPECT_TRUE(has(report_page(results, ""), "began at 2026-11-23T14:00:00Z and took 2.5 s\n"));
}

TEST(Report, TellsOrdersAndSolvesWhereNobodyHasJudged) {
  ResultsFolder results = folder_with(two_solves());
  results.tables.push_back(
      {"convergence_slopes.csv", "convergence",
       Table::from_csv("problem,method,tableau,stages,quantity,slope,standard_error,verdict\n"
                       "arm,dmoc,gauss,1,state,2.0123,0.0171,slope\n"
                       "arm,dmoc,gauss,1,control,1.9,,slope\narm,dmoc,gauss,1,costate,,,floor\n")});
  results.tables.push_back({"other_slopes.csv", "other",
                            Table::from_csv("problem,method,situation,quantity,slope,standard_error\n"
                                            "arm,dmoc,odd,state,7,1\n")});
  const auto overview = [&results] {
    const std::string page = report_page(results, "");
    return page.substr(0, page.find("</section>"));
  };
  EXPECT_TRUE(has(overview(),
                  "<b>arm by DMOC</b> (gauss, 1 stage per step): <a href=\"#table-convergence-slopes-csv\">"
                  "fitted orders</a> state 2.012 ± 0.017, control 1.900, costate: floor."));
  EXPECT_TRUE(has(overview(), "<b>arm by DMOC</b>: cost 0.123456789 with N = 16; 1 of 2 solves solved."));
  EXPECT_FALSE(has(overview(), "state 7"));
  results.claims = Table::from_csv("claim,verdict,whose,states,measured\narm/other,differs,paper,nothing,5\n");
  EXPECT_FALSE(has(overview(), "arm by DMOC"));
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

/// What stands between two marks for the first time; empty if nothing does.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return "";
  return text.substr(at + begin.size(), text.find(end, at + begin.size()) - at - begin.size());
}

TEST(Report, NothingOfAFigureStandsInThePageAsItIs) {
  ResultsFolder results;
  results.figures = {{"script", "<svg xmlns='http://www.w3.org/2000/svg'><script>alert(1)</script></svg>"},
                     {"event", "<svg onload=\"alert(2)\"/>"},
                     {"link", "<svg><a href='javascript:alert(3)'><text>x</text></a></svg>"},
                     {"end", "</svg>\"></figure><script>alert(4)</script>"},
                     {"bytes", "<svg>\xff\xfe alert(5)</svg>"},
                     {"number", "<svg><path d='M" + std::string(400, '9') + ",1.00'/></svg>"}};
  const std::string page = report_page(results, "");
  EXPECT_FALSE(has(page, "alert(") || has(page, "\xff") || has(page, "<svg") || has(page, "999999"));
  for (const ReportedFigure& figure : results.figures) {
    const std::string markup = between(page, fmt::format("<figure id=\"figure-{}\">", figure.name), "</figure>");
    EXPECT_EQ(markup, fmt::format("<img alt=\"{0}\" src=\"data:image/svg+xml;base64,{1}\"><figcaption>{0}</figcaption>",
                                  figure.name, base64(figure.svg)));
  }
}

TEST(Report, NamesOfFiguresEndNoAttribute) {
  ResultsFolder results;
  results.figures = {{"\" onerror=\"alert(1)", "no SVG"}, {"<img src=x onerror=alert(2)>", "<svg/>"}};
  const std::string page = report_page(results, "");
  EXPECT_TRUE(has(page, "<img alt=\"&quot; onerror=&quot;alert(1)\" src=\"data:"));
  EXPECT_FALSE(has(page, "<img src=x"));
}

TEST(Report, AllowsOneScriptByItsDigest) {
  for (const std::string& page :
       {report_page(folder_with(two_solves()), ""),
        comparison_page({"before", folder_with(two_solves())}, {"after", folder_with(two_solves())})}) {
    const std::string allowed = between(page, "script-src ", "\"");
    EXPECT_TRUE(allowed.starts_with("'sha256-") && allowed.ends_with("='") && allowed.size() == 53U) << allowed;
    EXPECT_EQ(page.find("<script"), page.rfind("<script"));
  }
}

TEST(Report, LinksToFilesLeadToFilesWhateverTheirNames) {
  ResultsFolder results;
  results.tables.push_back({"javascript:alert(1)||x.csv", "", two_solves()});
  results.tables.push_back({"a\"b #1?\xc3\xa4%.csv", "", two_solves()});
  const std::string page = report_page(results, "../my results/");
  EXPECT_TRUE(has(page, "<a href=\"./../my%20results/javascript%3Aalert%281%29%7C%7Cx.csv\" download>"));
  EXPECT_TRUE(has(page, "<a href=\"./../my%20results/a%22b%20%231%3F%C3%A4%25.csv\" download>"));
  EXPECT_TRUE(has(report_page(results, ""), "<a href=\"./javascript%3Aalert"));
}

TEST(Report, DrawsMotionsWithNumbersAtTheEndsOfTheRange) {
  ResultsFolder results;
  results.motions.push_back({"arm", "dmoc", Table::from_csv("t,x,y\n0,1e-310,0\n1,1.7976931348623157e308,-5e-324\n")});
  EXPECT_TRUE(has(report_page(results, ""), "1e-310"));
}

TEST(Report, ShowsTheRowsAndColumnsThatDecidedOnAClaimAndTheCommands) {
  ResultsFolder results = folder_with(two_solves());
  results.claims = Table::from_csv("claim,verdict,whose,states,evidence\narm/order,differs,ours,two,objective.csv\n");
  results.claim_rows = Table::from_csv(
      "claim,table,records,columns\narm/order,objective.csv,2-3 99,intervals objective\narm/order,none.csv,2,x\n");
  const std::string page = report_page(results, "");
  const std::size_t begin = page.find("<details class=\"rows\">");
  ASSERT_NE(begin, std::string::npos);
  const std::string rows = page.substr(begin, page.find("</table>", begin) - begin);
  EXPECT_TRUE(has(rows, "<tr><td>solved<td>16<td>0.123457"));
  EXPECT_TRUE(has(rows, "<tr class=\"unsolved\"><td>iteration limit<td>32<td>\n"));
  EXPECT_FALSE(has(rows, "<td>dmoc"));
  EXPECT_TRUE(has(page, "<code class=\"line\">objective --out x</code>\n<code class=\"line\">claims --out x</code>"));
}

TEST(Report, ChoosesRowsOfAClaimEvenlyWhereThereAreMany) {
  std::string csv = "n,error\n";
  for (int n = 1; n <= 101; ++n) csv += fmt::format("{},{}\n", n, 0.5 * n);
  ResultsFolder results = folder_with(Table::from_csv(csv));
  results.claims = Table::from_csv("claim,verdict,whose,states,evidence\narm/order,differs,ours,two,objective.csv\n");
  results.claim_rows = Table::from_csv("claim,table,records,columns\narm/order,objective.csv,2-102,n error\n");
  const std::string page = report_page(results, "");
  const std::size_t begin = page.find("<details class=\"rows\">");
  const std::string rows = page.substr(begin, page.find("</table>", begin) - begin);
  EXPECT_TRUE(has(rows, "101 rows of objective.csv, 24 of them here"));
  EXPECT_TRUE(has(rows, "<tr><td>1<td>0.5") && has(rows, "<tr><td>101<td>50.5"));
}

TEST(Report, AnswersFiveQuestionsByClaimsOnItsFirstScreen) {
  ResultsFolder results = folder_with(two_solves());
  results.claims = Table::from_csv(
      "claim,verdict,whose,states,measured\narm/equal_solutions,reproduced,paper,they are equal,to 1e-9; on 3 grids\n"
      "leg/equal_solutions,differs,paper,they are equal,to 1e-2\narm/other,differs,paper,nothing,5\n");
  const std::string page = report_page(results, "");
  const std::string overview = page.substr(0, page.find("<section id=\"claims\""));
  EXPECT_TRUE(has(overview, "<b>Accuracy</b>. They are equal: "));
  EXPECT_TRUE(has(overview, "reproduced</span>: to <span class=\"number\">1e-9</span>; "));
  EXPECT_TRUE(has(overview, "differs</span>: to <span class=\"number\">1e-2</span>."));
  EXPECT_FALSE(has(overview, "on 3 grids") || has(overview, "Structure"));
}

TEST(ComparedTables, PairRowsByWhatTheyAreAboutAndTellCountsAndStatusesThatDiffer) {
  Table first = Table::from_csv(
      "problem,method,intervals,status,major_iterations,objective,seconds\n"
      "arm,dmoc,16,solved,5,0.25,1\narm,dmoc,16,solved,7,0.5,1\narm,dmoc,32,solved,6,0.125,1\n");
  first.set_key({"problem", "method", "intervals", "sigma"});
  const Table second = Table::from_csv(
      "problem,method,intervals,status,major_iterations,objective,seconds\n"
      "arm,dmoc,64,solved,9,1,2\narm,dmoc,16,solved,5,0.75,2\narm,dmoc,16,time limit,8,0.5,2\n");
  const PairedRows rows = paired_rows(first, second);
  EXPECT_EQ(rows.pairs.size(), 2U);
  EXPECT_EQ(rows.alone, 2U);
  const std::vector<ChangedField> changes = changed_fields(first, second, rows);
  ASSERT_EQ(changes.size(), 2U);  // no objective, no time
  EXPECT_EQ(changes[0].column, "status");
  EXPECT_EQ(changes[0].second, "time limit");
  EXPECT_EQ(changes[1].first + " " + changes[1].second, "7 8");
  EXPECT_EQ(changes[1].about, "arm dmoc 16");
}

TEST(ComparedTables, JudgeTimesByRoundsAlone) {
  const auto table = [](const std::string& times) {
    Table result = Table::from_csv("problem,round_seconds\narm," + times + "\nleg,1 1\nfoot,\n");
    result.set_key({"problem"});
    return result;
  };
  const Table calm = table("1 1.1 0.9 1 1.05 0.95 1 1.02 0.98 1 1.01");
  const Table slow = table("2 2.1 1.9 2 2.05 1.95 2 2.02 1.98 2 2.01");
  const std::vector<ChangedTime> times = changed_times(paired_rows(calm, slow));
  ASSERT_EQ(times.size(), 2U);
  EXPECT_TRUE(times[0].is_changed());
  EXPECT_NEAR(times[0].ratio.ratio, 2.0, 1e-9);
  EXPECT_FALSE(times[1].is_judged());
  EXPECT_FALSE(changed_times(paired_rows(calm, calm)).front().is_changed());
}

TEST(Comparison, TellsClaimsWhoseVerdictChangedAndWhatOneRunLacks) {
  const ComparedRun first{"before", folder_with(two_solves())};
  ComparedRun second = first;
  second.name = "after";
  second.results.tables.clear();
  ComparedRun third = first;
  third.results.claims =
      Table::from_csv("claim,states,verdict,measured\narm/order,two,reproduced,2.0\narm/cost,less,differs,3\n");
  second.results.claims = Table::from_csv("claim,states,verdict,measured\narm/order,two,differs,1.0\n");
  const std::string page = comparison_page(third, second);
  EXPECT_TRUE(has(page, "1 claim has another verdict, 0 have the same one, 1 is in one of the runs only"));
  EXPECT_TRUE(has(page, "<td>arm/order<td>two<td>reproduced<td>differs<td>2.0<td>1.0"));
  EXPECT_TRUE(has(page, "Only in A: objective.csv."));
}

class ReportOfAFolder : public tests::InTemporaryFolder {};

TEST_F(ReportOfAFolder, LeavesOutWhatMetadataNestWithoutEnd) {
  const std::string deep = std::string(1000000, '[') + std::string(1000000, ']');
  write_file(folder() / "t.csv", "a,b\n1,2\n3,4\n");
  write_file(folder() / "t.json",
             fmt::format(R"({{"command_line": ["x"], "commit": "abc", "compiler": {0}, "motions": {0}}})", deep));
  const std::string page = report_page(read_results_folder(folder()), "");
  EXPECT_TRUE(has(page, "<dt>Commit<dd>abc"));
  EXPECT_FALSE(has(page, std::string(20, '[')));
}

TEST(Report, MotionsHaveRodsWhereDistancesStay) {
  ResultsFolder results;
  results.motions.push_back(
      {"arm", "dmoc", Table::from_csv("t_in_s,tip_x_in_m,tip_y_in_m,load_x_in_m,load_y_in_m\n0,1,0,2,0\n1,0,1,0,5\n")});
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
  EXPECT_TRUE(has(page, "q [m] from 1 to 3</text>"));
}

TEST(Report, QuantitiesOverTimeHaveControlsAndALineAtTheTime) {
  ResultsFolder results;
  results.motions.push_back({"spring", "dmoc", Table::from_csv("t_in_s,q_in_m,still\n0,1,2\n1,3,2\n")});
  results.motions.push_back({"spring", "tangent", Table::from_csv("t_in_s,q_in_m,still\n0,1,2\n2,3,2\n")});
  const std::string page = report_page(results, "");
  EXPECT_TRUE(has(page, "aria-label=\"Play spring\""));
  EXPECT_TRUE(has(page, R"("cursor":{"width":320.0,"height":100.0})"));
  EXPECT_TRUE(has(page, R"("points":[{"name":"q_in_m","x":[0.0,160.0],"y":[-96.0,-26.0],"rod":false}])"));
  EXPECT_TRUE(has(page, R"("points":[{"name":"q_in_m","x":[0.0,320.0],"y":[-96.0,-26.0],"rod":false}])"));
  results.motions = {{"stone", "dmoc", Table::from_csv("t_in_s,q_in_m\n0,1\n1,1\n")}};
  EXPECT_FALSE(has(report_page(results, ""), "aria-label=\"Play stone\""));
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

TEST(Report, StatesEveryProblemOfTheFolderNextToItsMotionAndNoOther) {
  const Table motion = Table::from_csv("t_[s],x_[m],y_[m]\n0,0,9\n1,1,8\n");
  const auto states = [](const std::string& page, const std::string& name) {
    return has(page, "<article id=\"" + anchor("problem", name) + "\">");
  };
  ResultsFolder results;
  results.motions.push_back({"hang_glider", "dmoc", motion});
  const std::string of_one = report_page(results, "");
  EXPECT_TRUE(has(of_one, "-1247.987601, 10 digits"));
  EXPECT_TRUE(has(of_one, "<p>Minimise <math><mrow><mi>Φ</mi></mrow></math></p>"));
  EXPECT_TRUE(has(of_one, fmt::format("Not solved in this folder: {} problems", problem_names().size() - 1)));
  for (const std::string& name : problem_names()) {
    EXPECT_EQ(states(of_one, name), name == "hang_glider") << name;
    results.motions.push_back({name, "dmoc", motion});
  }
  const std::string of_all = report_page(results, "");
  for (const std::string& name : problem_names()) EXPECT_TRUE(states(of_all, name)) << name;
}

}  // namespace
}  // namespace dmocbench
