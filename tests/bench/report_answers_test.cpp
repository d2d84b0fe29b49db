#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/claims/claim.hpp"
#include "bench/report/model.hpp"
#include "bench/report/page.hpp"
#include "bench/report/small_picture.hpp"

namespace dmocbench {
namespace {

using Json = nlohmann::ordered_json;

/// The fields of a table by method and problem, which a test may change before it asks for the answers.
struct Tables {
  std::map<std::string, std::string> errors;   ///< of the state on the finest grid
  std::map<std::string, std::string> replays;  ///< on the finest grid
  std::map<std::string, std::string> ratios;   ///< of variables
  std::map<std::string, std::string> times;    ///< ratio, lower, upper
  std::map<std::string, std::string> starts;   ///< confirmed, best
  std::string difference = "2e-13";            ///< of controls
  std::string verdict = "reproduced";          ///< of all claims

  Tables() {
    for (const std::string& problem : of_paper) {
      for (const char* const method : {"dmoc", "hamiltonian", "tangent"}) {
        const std::string key = problem + "," + method;
        errors[key] = replays[key] = "1e-5";
        ratios[key] = std::string(method) == "dmoc" ? "1" : "1.6";
        times[key] = "1.5,1.4,1.6";
        starts[key] = "80,40";
      }
    }
    replays[std::string(orbit) + ",tangent"] = "1.25e-5";
    replays[std::string(two_link) + ",tangent"] = "5e-6";
    starts[std::string(orbit) + ",tangent"] = "84,40";
    starts[std::string(two_link) + ",tangent"] = "76,40";
  }

  [[nodiscard]] ResultsFolder folder() const;
};

Json claim_on(const std::string& problem, const std::string& name, const std::string& verdict) {
  Json claim = Json::parse(R"({"where": "section 3.4", "figure": "", "states": "", "sure": "", "whose": "paper",
    "reasons": [], "evidence": [], "figures": [], "rows": []})");
  claim.update({{"claim", problem + "/" + name}, {"problem", problem}, {"name", name}, {"verdict", verdict}});
  claim["measured"] = {{{"text", ""}, {"numbers", {{{"name", "lowest"}, {"value", 1.5}, {"method", ""}}}}}};
  return claim;
}

ResultsFolder Tables::folder() const {
  const std::string scheme = "gauss,1,solved,";
  std::string convergence = "problem,method,tableau,stages,status,intervals,state_error,replay_error\n";
  std::string slopes = "problem,method,tableau,stages,quantity,slope\n";
  std::string consistency = "problem,method,tableau,stages,status,intervals,momentum_defect_max\n";
  std::string equivalence =
      "problem,method,status,intervals,configuration_difference,momentum_difference,control_difference,"
      "objective_difference\n";
  std::string accuracy = "problem,method,tableau,stages,quantity,variables_ratio\n";
  std::string savings =
      "problem,method,tableau,stages,solver,factorisation,intervals,quantity,round_ratios,ratio_lower,ratio_upper\n";
  std::string shares = "problem,method,tableau,stages,solver,start_kind,starts,confirmed,best,elsewhere\n";
  for (const auto& [key, error] : errors) {
    convergence += fmt::format("{0},{1}16,1e-3,1e-3\n{0},{1}512,{2},{3}\n", key, scheme, error, replays.at(key));
    slopes += key + ",gauss,1,state,1.99\n";
    consistency +=
        fmt::format("{0},{1}16,{2}\n{0},{1}512,{2}\n", key, scheme, key.ends_with("tangent") ? "1e-3" : "4e-13");
    for (const char* const quantity : {"state", "replay"})
      accuracy += fmt::format("{},gauss,1,{},{}\n", key, quantity, ratios.at(key));
    shares += fmt::format("{},gauss,1,interior_point,cold,100,{},10\n", key, starts.at(key));
    if (key.ends_with("dmoc")) continue;
    const std::string& time = times.at(key);
    savings += fmt::format("{},gauss,1,ipopt,,256,seconds_per_iteration,{},{}\n", key, time.substr(0, time.find(',')),
                           time.substr(time.find(',') + 1));
    if (key.ends_with("hamiltonian"))
      equivalence += fmt::format("{},solved,16,1e-14,1e-14,{},1e-15\n", key, difference);
  }
  ResultsFolder results;
  for (const auto& [file, csv] : std::map<std::string, std::string>{{"convergence.csv", convergence},
                                                                    {"convergence_slopes.csv", slopes},
                                                                    {"consistency.csv", consistency},
                                                                    {"equivalence.csv", equivalence},
                                                                    {"convergence_equal_accuracy.csv", accuracy},
                                                                    {"savings_by_solver_ratios.csv", savings},
                                                                    {"cold_start_shares.csv", shares}})
    results.tables.push_back({file, "", Table::from_csv(csv)});
  for (const std::string& problem : of_paper) {
    for (const char* const name : {"equal_solutions", "momentum_consistency", "collocation_takes_longer",
                                   "minor_iteration_ratio", "minor_iterations_saved_in_phase_1"})
      results.claims.push_back(claim_on(problem, name, verdict));
  }
  return results;
}

/// "answer but number" of the question that begins with a word; empty if it is left out.
std::string answer_to(const ResultsFolder& results, const std::string& question) {
  for (const Json& answer : answers_model(results)) {
    if (answer.at("question").get<std::string>().find(question) == std::string::npos) continue;
    return fmt::format("{} {} {}", answer.at("answer").get<std::string>(), answer.at("but").get<std::string>(),
                       answer.at("number").get<std::string>());
  }
  return "";
}

bool states(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(ReportAnswers, FollowTheLargestDifferenceAndTheVerdictOnEqualSolutions) {
  Tables tables;
  EXPECT_TRUE(states(answer_to(tables.folder(), "accurate"), "have equal solutions to round-off."));
  EXPECT_TRUE(states(answer_to(tables.folder(), "accurate"), "2·10⁻¹³"));
  tables.difference = "3e-5";
  tables.verdict = "differs";
  EXPECT_TRUE(states(answer_to(tables.folder(), "accurate"), "have different solutions."));
  EXPECT_TRUE(states(answer_to(tables.folder(), "accurate"), "3·10⁻⁵"));
  tables.verdict = "undecided";
  EXPECT_TRUE(states(answer_to(tables.folder(), "accurate"), "undecided"));
}

TEST(ReportAnswers, CompareErrorsOnTheFinestGridOfBothMethods) {
  Tables tables;
  EXPECT_TRUE(states(answer_to(tables.folder(), "accurate"), "its state error is equal on the orbit"));
  tables.errors[std::string(orbit) + ",tangent"] = "1.5e-5";
  tables.errors[std::string(two_link) + ",tangent"] = "9.9e-6";
  EXPECT_TRUE(states(answer_to(tables.folder(), "accurate"),
                     "its state error is 50 % larger on the orbit and on the arm 1 % smaller (N = 512)."));
}

TEST(ReportAnswers, StateBothDirectionsWhereReplayErrorsGoInOppositeOnes) {
  Tables tables;
  EXPECT_TRUE(states(
      answer_to(tables.folder(), "structure"),
      "The balance does not bound the error: when replayed, DMOC's controls miss the final state by 20 % less than "
      "tangent-space collocation on the orbit. On the arm they miss it by 100 % more (N = 512)."));
  tables.replays[std::string(two_link) + ",tangent"] = "1.25e-5";
  const std::string same = answer_to(tables.folder(), "structure");
  EXPECT_TRUE(states(same, "When replayed, DMOC's controls") && states(same, "by 20 % less (N = 512).")) << same;
  EXPECT_FALSE(states(same, "The balance does not bound"));
}

TEST(ReportAnswers, NameTheMethodWithFewerUnknownsOnlyIfItHasFewerOnBothProblems) {
  Tables tables;
  EXPECT_TRUE(states(answer_to(tables.folder(), "unknowns"), "DMOC, on both problems"));
  tables.ratios[std::string(two_link) + ",hamiltonian"] = "0.9";
  EXPECT_TRUE(states(answer_to(tables.folder(), "unknowns"), "It depends"));
  EXPECT_TRUE(states(answer_to(tables.folder(), "unknowns"), "0.9 to 1.6 ×"));
}

TEST(ReportAnswers, NameTheFasterMethodOnlyIfIntervalsAndVerdictExcludeEqualTimes) {
  Tables tables;
  EXPECT_TRUE(states(answer_to(tables.folder(), "faster"), "DMOC, per iteration."));
  tables.times[std::string(orbit) + ",tangent"] = "1.5,0.9,1.6";
  EXPECT_TRUE(states(answer_to(tables.folder(), "faster"), "do not always exclude equal times"));
  tables.times[std::string(orbit) + ",tangent"] = "0.8,0.7,0.9";
  EXPECT_TRUE(states(answer_to(tables.folder(), "faster"), "on both sides of 1"));
  tables = Tables();
  tables.verdict = "undecided";
  EXPECT_TRUE(states(answer_to(tables.folder(), "faster"), "the claim is undecided"));
  EXPECT_FALSE(states(answer_to(tables.folder(), "faster"), "as in the paper"));
}

TEST(ReportAnswers, NameTheMoreReliableMethodOnlyIfAllDifferencesHaveOneSign) {
  Tables tables;
  EXPECT_TRUE(states(answer_to(tables.folder(), "reliably"), "No method is clearly ahead"));
  EXPECT_TRUE(states(answer_to(tables.folder(), "reliably"), "4.0 points"));
  tables.starts[std::string(two_link) + ",tangent"] = "90,40";
  EXPECT_TRUE(states(answer_to(tables.folder(), "reliably"), "Collocation, on both problems."));
  EXPECT_TRUE(states(answer_to(tables.folder(), "reliably"), "10.0 points"));
}

TEST(ReportAnswers, LeaveOutAQuestionWhoseRowsAreMissing) {
  const ResultsFolder all = Tables().folder();
  EXPECT_EQ(answers_model(all).size(), 5U);
  for (std::size_t i = 0; i < all.tables.size(); ++i) {
    ResultsFolder without = all;
    without.tables.erase(without.tables.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_LT(answers_model(without).size(), 5U) << all.tables[i].file;
    EXPECT_GE(answers_model(without).size(), 3U) << all.tables[i].file;
  }
}

TEST(ReportAnswers, HaveAPictureOfEachProblemWithoutScripts) {
  const std::string page = report_page(Tables().folder(), "");
  const std::string answers = page.substr(page.find("<section id=\"answers\""), page.find("<section id=\"claims\""));
  std::size_t pictures = 0;
  for (std::size_t at = answers.find("<svg class=\"small\""); at != std::string::npos;
       at = answers.find("<svg class=\"small\"", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 10U);
}

TEST(SmallPicture, NamesEachCurveOnceAndApartAndCurvesThatCoincideTogether) {
  const std::vector<std::pair<double, double>> falling{{16, 1e-2}, {64, 1e-4}, {256, 1e-6}};
  std::vector<MethodCurve> curves{{"dmoc", falling}, {"hamiltonian", falling}, {"tangent", falling}};
  curves[2].points.back().second = 2e-6;
  const auto labels = [&curves] { return curves_picture("error", curves)["curves"]["labels"]; };
  ASSERT_EQ(labels().size(), 3U);
  EXPECT_EQ(labels()[1]["text"], "DMOC =");
  EXPECT_EQ(labels()[2]["text"], "Hamiltonian");
  for (std::size_t i = 1; i < 3; ++i)
    EXPECT_GE(labels()[i]["y"].get<double>(), labels()[i - 1]["y"].get<double>() + 11.0);
  EXPECT_LE(labels()[2]["y"].get<double>(), picture_height);
  curves[1].points[1].second = 1e-3;
  for (const Json& label : labels()) EXPECT_FALSE(states(label["text"].get<std::string>(), "="));
}

TEST(SmallPicture, OrdersPointsAsTheirValuesAndLeavesOutThoseThatLogarithmsLack) {
  const Json curves = curves_picture("error", {{"dmoc", {{16, 1e-2}, {64, 0.0}, {128, 1e-5}, {256, 1e-6}}}})["curves"];
  const Json& marks = curves["series"][0]["marks"];
  ASSERT_EQ(marks.size(), 3U);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_GT(marks[i]["x"].get<double>(), marks[i - 1]["x"].get<double>());
    EXPECT_GT(marks[i]["y"].get<double>(), marks[i - 1]["y"].get<double>());  // from above
  }
  EXPECT_LE(curves["xticks"].size(), 3U);
  EXPECT_LE(curves["yticks"].size(), 3U);
  EXPECT_TRUE(curves_picture("error", {{"dmoc", {{16, 1.0}}}}).is_null());
}

TEST(SmallPicture, BarsAreAsLongAsTheirNumbers) {
  const Json items = bars_picture("variables", {{"dmoc", 1.0}, {"tangent", 1.5}})["bars"]["items"];
  EXPECT_NEAR(items[1]["width"].get<double>() / items[0]["width"].get<double>(), 1.5, 0.01);
  const Json share = shares_picture("starts", {{"dmoc", 30.0, 20.0, 100.0}})["shares"]["items"][0];
  EXPECT_EQ(share["text"], "50 %");
  EXPECT_NEAR(share["best"].get<double>() / share["full"].get<double>(), 0.3, 0.01);
}

}  // namespace
}  // namespace dmocbench
