#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "bench/report/model.hpp"
#include "bench/report/page.hpp"
#include "bench/report/words.hpp"
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
  results.runs.back().metadata["tables"]["objective.csv"]["schema"]["properties"]["objective"] =
      Json{{"description", "of the trajectory"}, {"unit", "cost"}};
  results.tables.push_back({"objective.csv", "objective", std::move(table)});
  return results;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The text between two marks for the first time; empty if there is none.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return "";
  return text.substr(at + begin.size(), text.find(end, at + begin.size()) - at - begin.size());
}

/// The bytes of letters of base64.
std::string bytes_of(const std::string& letters) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned group = 0;
  int bits = 0;
  for (const char letter : letters) {
    if (letter == '=') break;
    group = (group << 6U) | static_cast<unsigned>(digits.find(letter));
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>(group >> static_cast<unsigned>(bits -= 8) & 0xFFU);
  }
  return bytes;
}

/// A figure or table that is packed in the page.
std::string unpacked(const std::string& page, const std::string& name) {
  const std::string bytes = bytes_of(between(page, "<script type=\"application/zlib\" id=\"data-" + name + "\">", "<"));
  std::string text(1000000, ' ');
  uLongf size = text.size();
  EXPECT_EQ(::uncompress(reinterpret_cast<Bytef*>(text.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                         bytes.size()),
            Z_OK)
      << name;
  text.resize(size);
  return text;
}

/// A claim as claims.json has it.
Json claim(const std::string& problem, const std::string& name, const std::string& whose, const std::string& verdict) {
  Json claim =
      Json::parse(R"({"where": "section 3.4, th:equi", "figure": "", "states": "they are equal", "sure": "exact",
    "measured": [{"text": "to 1e-9", "numbers": []}, {"text": "on 3 grids", "numbers": []}],
    "reasons": [], "evidence": ["objective.csv", "none.csv"], "figures": [], "rows": []})");
  claim.update({{"claim", problem + "/" + name}, {"problem", problem}, {"name", name}, {"whose", whose}});
  claim["verdict"] = verdict;
  return claim;
}

TEST(Words, WriteBytesInTheLettersOfBase64) {  // the examples of RFC 4648
  const std::vector<std::string> letters{"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t i = 0; i < letters.size(); ++i) EXPECT_EQ(base64(std::string("foobar").substr(0, i)), letters[i]);
  EXPECT_EQ(base64("\xfb\xff\xfe"), "+//+");
}

TEST(Words, WriteNumbersWithPowersOfTen) {
  EXPECT_EQ(scientific(2.6e-13), "3·10⁻¹³");
  EXPECT_EQ(scientific(9.6e-13), "1·10⁻¹²");
  EXPECT_EQ(tick(1e-6), "10⁻⁶");
  EXPECT_EQ(tick(512.0), "512");
}

TEST(Words, AgreeWithTheNumberOfStatements) {
  EXPECT_EQ(verdict_in_words("differs", "paper", 2), "differ");
  EXPECT_EQ(verdict_in_words("differs", "paper"), "differs");
  EXPECT_EQ(verdict_in_words("reproduced", "ours", 3), "hold");
  EXPECT_EQ(verdict_in_words("differs", "extension"), "does not hold");
  EXPECT_EQ(verdict_in_words("undecided", "ours", 3), "undecided");
}

TEST(Words, OfCommandsHaveNoFoldersOfAbsolutePaths) {
  EXPECT_EQ(without_folders("/home/a/results"), "results");
  EXPECT_EQ(without_folders("/home/a/results/"), "results");
  EXPECT_EQ(without_folders("--to=/home/a/b.html"), "--to=b.html");
  EXPECT_EQ(without_folders("/usr/bin/dmocbench convergence"), "dmocbench convergence");
  for (const char* const word : {"build/bench/solve", "--out", "16:1024", "/", ""})
    EXPECT_EQ(without_folders(word), word);
}

TEST(Words, NameMethodsAsFiguresDo) {
  EXPECT_EQ(method_in_words("dmoc"), "DMOC");
  EXPECT_EQ(method_in_words("multiple_shooting_rk4_1"), "Multiple shooting, rk4, 1 step");
  EXPECT_EQ(method_in_words("single_shooting_midpoint_2"), "Single shooting, midpoint, 2 steps");
  EXPECT_EQ(method_in_words("my_own"), "my own");
}

/// Claims of the paper and of the suite, and two figures, one of which a claim of the paper names.
ResultsFolder judged_folder() {
  ResultsFolder results = folder_with(two_solves());
  results.claims = {claim("orbital_transfer", "equal_solutions", "paper", "reproduced"),
                    claim("two_link_manipulator", "equal_solutions", "paper", "differs"),
                    claim("orbital_transfer", "ours", "ours", "differs")};
  results.claims.front()["figures"] = {"orbital_transfer_equal"};
  results.claims.front()["evidence"].push_back("figures/orbital_transfer_equal.svg");
  results.figures = {{"orbital_transfer_equal", "<svg/>"}, {"orbital_transfer_sweep", "<svg/>"}};
  return results;
}

TEST(Report, CountsTheStatementsOfThePaper) {
  const Json model = claims_model(judged_folder());
  EXPECT_EQ(model["reproduced"], 1);
  EXPECT_EQ(model["statements"], 2);
  EXPECT_EQ(model["score"], (Json{{{"verdict", "reproduced"}, {"count", 1}, {"words", "reproduced"}},
                                  {{"verdict", "differs"}, {"count", 1}, {"words", "differs"}}}));
  ASSERT_EQ(model["open"].size(), 1U);
  EXPECT_EQ(model["open"][0]["name"], "equal_solutions");
}

TEST(Report, PutsThePapersClaimsFirstAndClosesAll) {
  const std::string page = report_page(judged_folder(), "");
  const std::size_t paper =
      page.find("<details class=\"group\" id=\"group-section-3.4\"><summary><b>The paper, section 3.4</b>");
  const std::size_t claim_of_paper = page.find("<dl id=\"claim-orbital_transfer/equal_solutions\">");
  const std::size_t others = page.find("<details class=\"group\" id=\"group-Our-findings\">");
  const std::size_t ours = page.find("<dl id=\"claim-orbital_transfer/ours\">");
  ASSERT_NE(ours, std::string::npos);
  EXPECT_TRUE(paper < claim_of_paper && claim_of_paper < others && others < ours);
  EXPECT_FALSE(has(page, "<details open"));
}

TEST(Report, PutsAStatementAboutSeveralSectionsIntoTheFirst) {
  ResultsFolder results = judged_folder();
  results.claims.front()["where"] = "sections 2.2 and 3.4, th:equi";
  EXPECT_EQ(claims_model(results)["groups"][0]["title"], "section 2.2");
}

TEST(Report, SaysThatOwnStatementsHoldAndThatStatementsOfThePaperAreReproduced) {
  const Json groups = claims_model(judged_folder())["groups"];
  EXPECT_EQ(groups[1]["entries"][0]["items"][0]["verdict_words"], "does not hold");
  EXPECT_EQ(groups[1]["score"][0]["words"], "does not hold");
  EXPECT_EQ(groups[0]["entries"][0]["items"][0]["verdict_words"], "reproduced");
}

TEST(Report, MakesOneEntryOfAStatementAboutSeveralProblems) {
  ResultsFolder results = judged_folder();
  const auto entries = [&results] { return claims_model(results)["groups"][0]["entries"]; };
  ASSERT_EQ(entries().size(), 1U);
  EXPECT_EQ(entries()[0]["items"].size(), 2U);
  results.claims.front()["states"] = "they are not";
  ASSERT_EQ(entries().size(), 2U);
  EXPECT_EQ(entries()[0]["states"], "they are equal");  // it differs: first
}

TEST(Report, ShowsOppositeFindingsOfOneNameNextToEachOtherAsTwoSentences) {
  ResultsFolder results;
  for (const char* const name : {"replay", "other"}) results.claims.push_back(claim("arm", name, "ours", "reproduced"));
  results.claims.push_back(claim("orbit", "replay", "ours", "reproduced"));
  results.claims.back()["states"] = "they are not equal";
  const Json entries = claims_model(results)["groups"][0]["entries"];
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries[1]["name"], "replay");
  EXPECT_NE(entries[0]["states"], entries[1]["states"]);
}

TEST(Report, ShowsOneNumberOfEachMethodWhereAClaimStatesTheSameOfAll) {
  ResultsFolder results = judged_folder();
  Json& numbers = results.claims.front()["measured"][0]["numbers"];
  numbers = {{{"name", "slope"}, {"value", 1.98765}, {"method", "dmoc"}},
             {{"name", "slope"}, {"value", 2.0}, {"method", "tangent"}}};
  const auto values = [&results] { return claims_model(results)["groups"][0]["entries"][0]["items"][0]["values"]; };
  EXPECT_EQ(values(), (Json{{{"method", "dmoc"}, {"text", "1.99"}}, {{"method", "tangent"}, {"text", "2"}}}));
  numbers[1]["name"] = "error";
  EXPECT_TRUE(values().empty());
  numbers[1]["name"] = "slope";
  numbers[1]["method"] = "dmoc";
  EXPECT_TRUE(values().empty());
}

TEST(Report, GroupsFiguresByThePapersSectionsThenByKind) {
  const Json groups = figures_model(judged_folder(), "");
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_TRUE(groups[0]["of_paper"]);
  EXPECT_EQ(groups[0]["kinds"][0]["kind"], "section 3.4");
  EXPECT_EQ(groups[0]["kinds"][0]["figures"][0]["figure"], "orbital_transfer_equal");
  EXPECT_EQ(groups[1]["kinds"][0]["kind"], "sweep");
  EXPECT_EQ(groups[1]["kinds"][0]["figures"][0]["figure"], "orbital_transfer_sweep");
}

TEST(Report, HoldsTheFieldsOfItsTablesWithTheMeaningsOfTheirColumns) {
  const ResultsFolder results = folder_with(two_solves());
  const std::string page = report_page(results, "");
  const Json table = Json::parse(unpacked(page, "table-objective.csv"));
  const Table written = two_solves();
  ASSERT_EQ(table["rows"].size(), written.rows().size());
  for (std::size_t i = 0; i < written.rows().size(); ++i) {
    for (std::size_t k = 0; k < written.columns().size(); ++k) {
      EXPECT_EQ(table["columns"][k]["name"], written.columns()[k]);
      EXPECT_EQ(table["rows"][i][k], written.rows()[i].text(written.columns()[k]));
    }
  }
  EXPECT_EQ(table["columns"][4]["meaning"], "of the trajectory");
  EXPECT_EQ(table["columns"][4]["unit"], "cost");
  EXPECT_EQ(table["columns"][0]["meaning"], "");
  EXPECT_TRUE(has(page, "2 rows, 6 columns, 1 not solved"));
  EXPECT_TRUE(has(page, "<code>objective --out x</code>"));
}

TEST(Report, HoldsTheFirstRowsOfLongTablesAndSaysSo) {
  std::string csv = "n\n";
  for (std::size_t n = 0; n < most_rows + 2; ++n) csv += fmt::format("{}\n", n);
  const ResultsFolder results = folder_with(Table::from_csv(csv));
  EXPECT_EQ(table_json(results.tables.front(), nullptr)["rows"].size(), most_rows);
  EXPECT_TRUE(has(report_page(results, ""), fmt::format("This page has the first {} rows.", most_rows)));
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
  EXPECT_TRUE(has(report_page(results, ""), "<dt>First run began<dd>2026-11-23T14:00:00Z\n"));
  results.runs.front().metadata["wall_seconds"] = 6000.0;  // it ends last
  results.runs.back().metadata["wall_seconds"] = 30.0;
  EXPECT_TRUE(has(report_page(results, ""), "2026-11-23T14:00:00Z; the last run ended 100.0 minutes later\n"));
  results.runs.pop_back();
  results.runs.front().metadata["wall_seconds"] = 2.5;
  EXPECT_TRUE(has(report_page(results, ""), "; the last run ended 2.5 s later\n"));
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
  const auto lines = [&results] { return between(report_page(results, ""), "<section id=\"answers\"", "</section>"); };
  const std::string link = "<a href=\"#table-convergence_slopes.csv\">";
  EXPECT_TRUE(has(lines(), "<b>arm by DMOC</b> (gauss, 1 stage): fitted orders " + link + "state 2.012 ± 0.017</a>, " +
                               link + "control 1.900</a>, " + link + "costate: floor</a></li>"));
  EXPECT_TRUE(has(lines(), "<b>arm by DMOC</b>: cost 0.123456789 with N = 16; 1 of 2 solves succeeded<"));
  EXPECT_FALSE(has(lines(), "state 7"));
  results.claims = {claim("arm", "other", "paper", "differs")};
  EXPECT_FALSE(has(lines(), "arm by DMOC"));
}

/// A folder with the cost of equal accuracy: the methods need these numbers of variables for equal errors.
ResultsFolder folder_with_costs(const std::vector<std::pair<std::string, int>>& variables, int solved_of_last = 2) {
  ResultsFolder results;
  std::string solves = "problem,method,tableau,stages,solver,derivatives,status,intervals\n";
  std::string costs = "problem,tableau,stages,solver,derivatives,quantity,error,method,variables\n";
  for (const auto& [method, count] : variables) {
    const bool is_last = method == variables.back().first;
    for (int grid = 0; grid < 2; ++grid)
      solves += fmt::format("arm,{},gauss,1,auto,tape,{},{}\n", method,
                            is_last && grid >= solved_of_last ? "time limit" : "solved", 16 << grid);
    for (const char* const quantity : {"state", "replay"}) {
      for (const int tenfold : {1, 10})
        costs += fmt::format("arm,gauss,1,auto,tape,{},{},{},{}\n", quantity, 0.1 / tenfold, method, count * tenfold);
    }
  }
  results.tables.push_back({"convergence.csv", "convergence", Table::from_csv(solves)});
  results.tables.push_back({"convergence_equal_accuracy.csv", "convergence", Table::from_csv(costs)});
  return results;
}

TEST(Report, RecommendsTheMethodThatNeedsTheFewestVariablesWhicheverItIs) {
  const std::vector<std::string> methods{"dmoc", "hamiltonian", "tangent"};
  for (std::size_t best = 0; best < methods.size(); ++best) {
    std::vector<std::pair<std::string, int>> variables;
    for (std::size_t i = 0; i < methods.size(); ++i) variables.emplace_back(methods[i], i == best ? 10 : 20);
    const Json all = recommendations_model(folder_with_costs(variables));
    ASSERT_EQ(all.size(), 1U);
    const auto text = all[0].at("text").get<std::string>();
    EXPECT_TRUE(has(text, "Use " + methods[best] + " for arm: at a state error of 1.0e-02")) << text;
    EXPECT_TRUE(has(text, " needs 100 free variables")) << text;
    EXPECT_TRUE(has(text, "200 (2.00 times as many)")) << text;
  }
}

TEST(Report, RecommendsNoMethodWithoutADifferenceOrACommonError) {
  const auto text = [](const ResultsFolder& results) {
    return recommendations_model(results).at(0).at("text").get<std::string>();
  };
  EXPECT_TRUE(has(text(folder_with_costs({{"dmoc", 100}, {"tangent", 104}})), "No method is ahead for arm"));
  EXPECT_TRUE(has(text(folder_with_costs({{"dmoc", 100}, {"tangent", 200}}, 1)),
                  "With tangent, 1 of 2 grids have a usable solution."));
  ResultsFolder without_states = folder_with_costs({{"dmoc", 100}});
  std::string costs = without_states.tables.back().table.csv();
  for (std::size_t at = costs.find("state"); at != std::string::npos; at = costs.find("state")) costs[at] = 'x';
  without_states.tables.back().table = Table::from_csv(costs);
  EXPECT_TRUE(has(text(without_states), "No method is recommended for arm"));
}

TEST(Report, ShowsTheOrdersOfTheSolutionBeforeAllOthers) {
  ResultsFolder results;
  const std::string head = "problem,method,tableau,stages,quantity,slope,standard_error,verdict\n";
  results.tables.push_back({"a_slopes.csv", "a", Table::from_csv(head + "arm,dmoc,,,gap,2,0.1,slope\n")});
  results.tables.push_back(
      {"b_slopes.csv", "b",
       Table::from_csv(head + "arm,dmoc,gauss,1,momentum,2,0.1,slope\narm,dmoc,gauss,1,objective,2,0.1,slope\n"
                              "arm,dmoc,gauss,1,state,2,0.1,slope\n")});
  std::vector<std::string> quantities;
  for (const Json& line : measured_model(results)) {
    for (const Json& order : line.at("orders")) quantities.push_back(order.at("text").get<std::string>());
  }
  EXPECT_EQ(quantities, (std::vector<std::string>{"state 2.000 ± 0.1", "objective 2.000 ± 0.1", "momentum 2.000 ± 0.1",
                                                  "gap 2.000 ± 0.1"}));
}

TEST(Report, RunsNothingThatStandsInATableAClaimOrAMotion) {
  const std::string hostile = "\"></summary><script>alert(1)</script>'&{{script}}";
  ResultsFolder results = folder_with(Table::from_csv("problem,<img>\n<script>alert(1)</script>,</table>\nb,c\n"));
  Json of_all = claim(hostile, hostile, hostile, hostile);
  for (const char* const key : {"where", "figure", "states", "sure"}) of_all[key] = hostile;
  of_all["measured"][0]["text"] = of_all["evidence"][0] = hostile;
  of_all["reasons"] = {{{"text", hostile}, {"numbers", Json::array()}}};
  of_all["rows"] = {{{"table", "objective.csv"}, {"records", {2}}, {"columns", {hostile}}}};
  results.claims = {of_all};
  results.motions.push_back({hostile, hostile, Table::from_csv("t,</script>_x,</script>_y\n0,1,0\n1,0,1\n")});
  results.motions.push_back({hostile + "2", "<dmoc>", Table::from_csv("t,</text><script>\n0,1\n1,2\n")});
  results.tables.push_back({hostile, hostile, two_solves()});
  results.runs.front().metadata["command_line"] = {hostile, hostile};
  results.runs.front().metadata["commit"] = hostile;
  results.runs.front().metadata["not_solved"] = 1;
  results.runs.front().name = hostile;
  results.faults = {hostile};
  const std::string page = report_page(results, "");
  EXPECT_FALSE(has(page, "<script>alert"));
  EXPECT_FALSE(has(page, "\"></summary>"));
  EXPECT_FALSE(has(page, "<img>") || has(page, "<dmoc>") || has(page, "</text><script>"));
  EXPECT_TRUE(has(page, "&quot;&gt;&lt;/summary&gt;&lt;script&gt;alert(1)&lt;/script&gt;&apos;&amp;{{script}}"));
}

TEST(Report, IsValidTextWhateverBytesNamesHave) {
  ResultsFolder results = folder_with(Table::from_csv("problem,\xff\n\xc3,\xfe\nb,c\n"));
  results.faults = {"q̇ ≤ 1 \xff|\xc3"};
  const std::string page = report_page(results, "");
  EXPECT_FALSE(has(page, "\xff"));
  EXPECT_TRUE(has(page, "q̇ ≤ 1 \ufffd|\ufffd</p>"));
  EXPECT_TRUE(Json::accept(unpacked(page, "table-objective.csv")));
}

TEST(Report, NothingOfAFigureStandsInThePageAsItIs) {
  ResultsFolder results;
  results.figures = {{"script", "<svg xmlns='http://www.w3.org/2000/svg'><script>alert(1)</script></svg>"},
                     {"event", "<svg onload=\"alert(2)\"/>"},
                     {"link", "<svg><a href='javascript:alert(3)'><text>x</text></a></svg>"},
                     {"end", "</svg>\"></figure><script>alert(4)</script>"},
                     {"bytes", "<svg>\xff\xfe alert(5)</svg>"},
                     {"number", "<svg><path d='M" + std::string(400, '9') + ",1.00'/></svg>"},
                     {"\" onerror=\"alert", "no SVG"},
                     {"<img src=x onerror=alert>", "<svg/>"}};
  const std::string page = report_page(results, "");
  EXPECT_FALSE(has(page, "alert(") || has(page, "\xff") || has(page, "999999"));
  EXPECT_TRUE(has(page, "data-figure=\"&quot; onerror=&quot;alert\" aria-label="));
  EXPECT_FALSE(has(page, "<img src=x") || has(page, "\" onerror=\"alert"));
  results.figures.resize(6);
  for (const ReportedFigure& figure : results.figures) EXPECT_EQ(unpacked(page, "figure-" + figure.name), figure.svg);
}

TEST(Report, AllowsOneScriptByItsDigest) {
  const std::string page = report_page(judged_folder(), "");
  const std::string allowed = between(page, "script-src ", "\"");
  EXPECT_TRUE(allowed.starts_with("'sha256-") && allowed.ends_with("='") && allowed.size() == 53U) << allowed;
  EXPECT_EQ(page.find("<script>"), page.rfind("<script>"));
  EXPECT_FALSE(has(page, "{{"));
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

TEST(Report, LinksToTheRowsAndColumnsThatDecidedOnAClaimAndShowsTheCommands) {
  ResultsFolder results = folder_with(two_solves());
  results.claims = {claim("arm", "order", "ours", "differs")};
  results.claims.front()["rows"] = {
      {{"table", "objective.csv"}, {"records", {2, 3, 99}}, {"columns", {"intervals", "objective"}}},
      {{"table", "gone.csv"}, {"records", {2}}, {"columns", {"x"}}}};
  const std::string page = report_page(results, "");
  EXPECT_TRUE(has(page,
                  "<a href=\"#table-objective.csv\" data-records=\"2-3 99\" data-columns=\"intervals "
                  "objective\">objective.csv</a>"));
  EXPECT_TRUE(has(page, "none.csv (missing)"));
  EXPECT_FALSE(has(page, "gone.csv"));
  EXPECT_TRUE(has(page, "<code class=\"line\">objective --out x</code><code class=\"line\">claims --out x</code>"));
  results.runs.front().metadata["command_line"] = {"/usr/bin/objective", "--out", "/home/a/x"};
  EXPECT_TRUE(has(report_page(results, ""),
                  "<code class=\"line\">objective --out x</code><code class=\"line\">claims --out x</code>"));
  results.runs.front().metadata["command_line"] = {"bin/dmocbench objective", "--out", "x"};
  EXPECT_TRUE(has(report_page(results, ""), "<code class=\"line\">bin/dmocbench claims --out x</code>"));
}

TEST(Report, DrawsMotionsWithNumbersAtTheEndsOfTheRange) {
  ResultsFolder results;
  results.motions.push_back({"arm", "dmoc", Table::from_csv("t,x,y\n0,1e-310,0\n1,1.7976931348623157e308,-5e-324\n")});
  EXPECT_TRUE(has(report_page(results, ""), "1e-310"));
}

TEST(Report, DrawsThePathsOfAllPointsOfAMotionWithTheirTimes) {
  const ReportedMotion motion{
      "arm", "dmoc", Table::from_csv("t_in_s,tip_x_in_m,tip_y_in_m,load_x_in_m,load_y_in_m\n0,1,0,2,0\n1,0,1,0,5\n")};
  const Json model = motion_model({&motion});
  EXPECT_EQ(model["motions"][0]["paths"], (Json{"1,-0 0,-1 ", "2,-0 0,-5 "}));
  EXPECT_EQ(model["motions"][0]["times"], "0 1 ");
  EXPECT_EQ(model["unit"], "s");
}

TEST(Report, DrawsOneMotionOfEachMethodAndQuantitiesWhereNothingMovesInThePlane) {
  ResultsFolder results;
  const Table plane = Table::from_csv("t_[s],x,y\n0,0,0\n1,1,1\n");
  for (const char* const method : {"dmoc", "tangent", "dmoc"}) results.motions.push_back({"arm", method, plane});
  results.motions.push_back({"spring", "dmoc", Table::from_csv("t_[s],q_[m]\n0,1\n1,3\n")});
  const Json problems = gallery_model(results)["problems"];
  EXPECT_EQ(problems[0]["motion"]["motions"].size(), 2U);
  const std::string page = report_page(results, "");
  EXPECT_TRUE(has(page, "<g class=\"tangent\" data-times=\"0 1 \"><polyline points=\"0,-0 1,-1 \"/></g>"));
  EXPECT_TRUE(has(page, "q [m] from 1 to 3</text>"));
}

TEST(Report, QuantitiesOverTimeShareTheirScalesAndHaveControls) {
  ResultsFolder results;
  results.motions.push_back({"spring", "dmoc", Table::from_csv("t_in_s,q_in_m,still\n0,1,2\n1,3,2\n")});
  results.motions.push_back({"spring", "tangent", Table::from_csv("t_in_s,q_in_m,still\n0,1,2\n2,3,2\n")});
  EXPECT_TRUE(has(report_page(results, ""), "aria-label=\"Play spring\""));
  const Json motion = gallery_model(results)["problems"][0]["motion"];
  ASSERT_EQ(motion["strips"].size(), 1U);  // one quantity changes
  EXPECT_EQ(motion["end"], "2");
  EXPECT_EQ(motion["strips"][0]["curves"][0]["points"], "0,90 160,20 ");
  EXPECT_EQ(motion["strips"][0]["curves"][1]["points"], "0,90 320,20 ");
  results.motions = {{"stone", "dmoc", Table::from_csv("t_in_s,q_in_m\n0,1\n1,1\n")}};
  EXPECT_FALSE(has(report_page(results, ""), "aria-label=\"Play stone\""));
}

TEST(Report, TellsWhichMethodsReachTheOptimumOfAProblemAsItIsStated) {
  ResultsFolder results = folder_with(Table::from_csv(
      "problem,method,status,objective\narm,dmoc,solved,1.001\narm,dmoc,solved,2\narm,dmoc,iteration limit,1\n"
      "arm,tangent,solved,3\nleg,dmoc,solved,1\n"));
  const Json methods = reached_model(results, "arm", 1.0);
  ASSERT_EQ(methods.size(), 2U);
  EXPECT_EQ(methods[0]["rows"], 3);
  EXPECT_EQ(methods[0]["solved"], 2);
  EXPECT_EQ(methods[0]["near"], 1);
  EXPECT_EQ(methods[0]["difference"], "0.001");
  EXPECT_EQ(methods[1]["near"], 0);
  EXPECT_FALSE(methods[1]["reaches"]);
  results.runs.front().metadata["command_line"] = {"objective", "--set", "mass=2"};
  EXPECT_TRUE(reached_model(results, "arm", 1.0).empty());
}

TEST(Report, NamesTheLowestCostWhereNoOptimumIsKnown) {
  const std::vector<std::string> names = problem_names();
  const auto unknown =
      std::ranges::find_if(names, [](const std::string& name) { return !make_problem(name)->card().reference; });
  ASSERT_NE(unknown, names.end());
  ResultsFolder results = folder_with(Table::from_csv(fmt::format(
      "problem,method,status,objective\n{0},dmoc,solved,1.5\n{0},dmoc,solved,2\n{0},dmoc,iteration limit,1\n",
      *unknown)));
  results.motions.push_back({*unknown, "dmoc", Table::from_csv("t,x,y\n0,0,0\n1,1,1\n")});
  const Json facts = gallery_model(results)["problems"][0]["facts"];
  EXPECT_EQ(facts[0]["text"], "not known; the best cost found here is 1.5");
}

TEST(Report, StatesEveryProblemOfTheFolderNextToItsMotionAndNoOther) {
  const Table motion = Table::from_csv("t_[s],x_[m],y_[m]\n0,0,9\n1,1,8\n");
  const auto states = [](const std::string& page, const std::string& name) {
    return has(page, "<details class=\"problem\" id=\"problem-" + name + "\">");
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

/// Calls `take` with the JSON in which one value, at any place, has another type.
void for_each_damage(const Json& whole, const std::function<void(const Json&)>& take) {
  std::set<std::string> places;
  const Json flat = whole.flatten();
  for (const auto& [place, value] : flat.items()) {
    for (std::string inner = place; !inner.empty(); inner.erase(inner.rfind('/'))) places.insert(inner);
  }
  for (const std::string& place : places) {
    for (const Json& other : {Json(7), Json("x"), Json(true), Json(nullptr), Json::array({1}), Json{{"a", 1}}}) {
      Json damaged = whole;
      damaged[Json::json_pointer(place)] = other;
      take(damaged);
    }
  }
}

class ReportOnDisk : public tests::InTemporaryFolder {
 protected:
  /// The page of a solve and of a file with this text.
  [[nodiscard]] std::string page_with(const std::string& file, const std::string& text) const {
    write_file(folder() / "objective.csv", "problem,method,status,intervals,objective\narm,dmoc,solved,16,0.125\n");
    write_file(folder() / file, text);
    return report_page(read_results_folder(folder()), "");
  }
};

TEST_F(ReportOnDisk, StandsWhateverTypesMetadataHave) {
  const Json whole = Json::parse(R"({"command_line": ["objective", "--out", "x"], "utc_time": "2026-01-01T00:00:00Z",
    "wall_seconds": 1.5, "commit": "a", "complete": true, "rows": 2, "not_solved": 1, "cost_scale": {"arm": 1.0},
    "motions": [{"nodes": "motion_arm_nodes.csv", "problem": "arm", "method": "dmoc"}],
    "tables": {"objective.csv": {"columns": ["problem"], "schema": {"properties": {"problem": {"description": "its name"}}}}}})");
  for_each_damage(whole, [this](const Json& metadata) {
    EXPECT_TRUE(has(page_with("objective.json", metadata.dump()), "objective.csv")) << metadata;
  });
}

TEST_F(ReportOnDisk, StandsWhateverTypesClaimsHave) {
  const Json whole = Json::parse(R"({"claims": [{"claim": "arm/same", "problem": "arm", "name": "same",
    "where": "section 3", "figure": "", "whose": "paper", "states": "equal", "verdict": "reproduced", "sure": "exact",
    "measured": [{"text": "equal", "numbers": [{"name": "gap", "value": 1e-9, "method": "dmoc"}]}], "reasons": [],
    "evidence": ["objective.csv"], "figures": ["f"],
    "rows": [{"table": "objective.csv", "records": [2], "columns": ["objective"]}]}], "findings": []})");
  EXPECT_TRUE(has(page_with("claims.json", whole.dump()), "data-records=\"2\""));
  for_each_damage(whole, [this](const Json& claims) {
    const std::string page = page_with("claims.json", claims.dump());
    EXPECT_TRUE(has(page, "data-records=") || has(page, "<p class=\"warning\">claims.json")) << claims;
  });
}

TEST_F(ReportOnDisk, LeavesOutWhatMetadataNestWithoutEnd) {
  const std::string deep = std::string(1000000, '[') + std::string(1000000, ']');
  const std::string page = page_with("objective.json", fmt::format(R"({{"command_line": ["x"], "commit": "abc",
    "compiler": {0}, "motions": {0}}})",
                                                                   deep));
  EXPECT_TRUE(has(page, "<dt>Commit<dd>abc"));
  EXPECT_FALSE(has(page, std::string(20, '[')));
}

TEST_F(ReportOnDisk, NamesTheFileAndTheKeyOfMetadataOfAnotherType) {
  for (const auto& [key, metadata] :
       {std::pair("complete", Json{{"command_line", {"x"}}, {"complete", "yes"}}),
        std::pair("command_line", Json{{"command_line", 7}}), std::pair("command_line 1", Json{{"command_line", {7}}}),
        std::pair("utc_time", Json{{"command_line", {"x"}}, {"utc_time", 7}})}) {
    EXPECT_TRUE(has(page_with("objective.json", metadata.dump()), std::string("objective.json: ") + key + " is "))
        << metadata;
  }
}

}  // namespace
}  // namespace dmocbench
