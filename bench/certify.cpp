// Which value of a problem's least cost can be trusted: routes to it that share as little as possible, compared with
// the reference that the problem states.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/experiment/experiment.hpp"
#include "bench/experiment/independent_checks.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/summary/agreement_of_routes.hpp"
#include "methods/error.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/transcription/tableau.hpp"

namespace dmocbench {

namespace {

struct Scheme {
  std::string tableau;
  int stages = 1;
};

/// "lobatto4" is lobatto with four stages.
Scheme parse_scheme(const std::string& text) {
  const std::size_t digits = text.find_first_of("0123456789");
  if (digits == 0 || digits == std::string::npos || text.size() - digits > 2 ||
      text.find_first_not_of("0123456789", digits) != std::string::npos) {
    throw Error(fmt::format("--routes takes tableaus with their stages like gauss3,lobatto4, not {}", text));
  }
  Scheme scheme{text.substr(0, digits), std::stoi(text.substr(digits))};
  static_cast<void>(make_tableau(scheme.tableau, scheme.stages));  // refuses what is not offered
  return scheme;
}

class Certify final : public Experiment {
 public:
  // Digits are wanted that end where the solver's tolerance begins, so answers are polished.
  Certify()
      : Experiment(
            {.name = "certify",
             .description =
                 "The least cost by routes that share as little as possible: two tableaus on two grids each, the "
                 "finest answer's control replayed, and the indirect method where it applies. NAME_references.csv has "
                 "a row per problem: the routes, how many digits they share, and whether they confirm the reference "
                 "that the problem states.",
             .options = {.problems = {"all"}, .methods = {"dmoc"}, .intervals = "64,128"},
             .problems_are_independent = true,
             .polishes = true}) {}
  [[nodiscard]] Columns<SolvedCase> columns() const override {
    return {
        replay_error_column(replay_),
        {"replay_objective", "cost", "cost of the replayed motion", of(replay_, &ReplayError::cost)},
        {"polish_steps", "", "Newton steps behind the solver", from(&SolvedCase::polish_steps)},
        {"indirect_objective", "cost", "cost by the indirect method", of(indirect_, &IndirectSolution::cost)},
        {"indirect_digits", "", "digits of it that are certified", of(indirect_, &IndirectSolution::certified_digits)},
        {"indirect_message", "", "why there is none", of(indirect_message_)},
    };
  }
  void add_options(CommandLine& line) override {
    line.option("--routes", route_names_, "tableaus with their stages; they replace --tableau and --stages")
        .comma_separated()
        .shows_default();
    line.flag("!--no-indirect", with_indirect_, "leave the indirect method out");
  }
  [[nodiscard]] std::vector<Case> variants(const std::vector<Case>& curve) const override {
    std::vector<Case> cases;
    for (const std::string& route : route_names_) {
      const Scheme scheme = parse_scheme(route);
      for (Case each : curve) {
        each.tableau = scheme.tableau;
        each.stages = scheme.stages;
        cases.push_back(std::move(each));
      }
    }
    return cases;
  }

  void check(const std::vector<Case>& cases) override {
    for (const Case& the_case : cases) {
      if (problems_.empty() || problems_.back().problem != the_case.problem) problems_.push_back({the_case.problem});
      ++problems_.back().cases_left;
    }
  }

  /// The indirect method starts at an answer and follows the last of a problem's cases, in that row.
  void complete(SolvedCase& solved) override {
    replay_.reset();
    indirect_.reset();
    indirect_message_.clear();
    CertifiedProblem& certified = *std::ranges::find(problems_, solved.the_case.problem, &CertifiedProblem::problem);
    if (solved.trajectory && is_solved(solved.solution.status)) {
      replay_ = replay(solved);
      const bool is_finer = !certified.finest || certified.finest->intervals() < solved.trajectory->intervals();
      if (is_finer) certified.finest = *solved.trajectory;
    }
    if (--certified.cases_left > 0 || !with_indirect_ || !certified.finest) return;
    try {
      indirect_ = solve_indirect(*certified.problem, *certified.finest);
    } catch (const Error& error) {  // says what of the problem it does not know
      indirect_message_ = error.what();
    }
  }

  void finish(const Table& table, const std::filesystem::path& prefix, nlohmann::ordered_json& /*metadata*/) override {
    std::vector<std::string> columns{"problem"};
    for (const std::string& route : route_names_) columns.push_back(route + "_objective");
    for (const char* column :
         {"replay_objective", "replay_error", "indirect_objective", "indirect_digits", "agreeing_digits", "reference",
          "reference_digits", "certificate", "reference_agreement", "confirmed", "published", "remark", "message"}) {
      columns.emplace_back(column);
    }
    Table references(columns);
    for (const CertifiedProblem& certified : problems_) {
      references.append(reference_row(*certified.problem, table));
      const Row& row = references.rows().back();
      fmt::print("certify: {}: {} digits agree; reference confirmed: {}\n", row.text("problem"),
                 row.text("agreeing_digits"), row.text("confirmed"));
    }
    write_file(prefix.string() + "_references.csv", references.csv());
  }

 private:
  struct CertifiedProblem {
    std::shared_ptr<const Problem> problem;
    std::size_t cases_left = 0;
    std::optional<Trajectory> finest = std::nullopt;  // the first answer on the finest grid so far
  };

  /// From the rows of one problem: the finest answer of every route, the best replay on the finest grid, the indirect
  /// method's.
  [[nodiscard]] Row reference_row(const Problem& problem, const Table& table) const {
    Row row;
    row.set("problem", problem.name());
    std::map<std::string, const Row*> finest;  // by route
    const Row* replayed = nullptr;
    const auto intervals = [](const Row& solve) { return solve.number("intervals").value_or(0.0); };
    const auto replay_of = [](const Row& solve) { return solve.number("replay_error").value_or(0.0); };
    for (const Row& solve : table.rows()) {
      if (solve.text("problem") != problem.name()) continue;
      for (const char* column : {"indirect_objective", "indirect_digits"}) {
        if (const auto value = solve.number(column)) row.set(column, value);
      }
      if (!solve.text("indirect_message").empty()) row.set("message", solve.text("indirect_message"));
      if (solve.text("status") != "solved" || !solve.number("objective")) continue;
      const Row*& best = finest[solve.text("tableau") + solve.text("stages")];
      if (best == nullptr || intervals(*best) <= intervals(solve)) best = &solve;
      if (!solve.number("replay_error")) continue;
      const bool is_better = replayed == nullptr || intervals(*replayed) < intervals(solve) ||
                             (intervals(*replayed) == intervals(solve) && replay_of(solve) < replay_of(*replayed));
      if (is_better) replayed = &solve;
    }
    std::vector<double> objectives;
    for (const auto& [route, solve] : finest) {
      const double objective = solve->number("objective").value_or(0.0);
      objectives.push_back(objective);
      row.set(route + "_objective", objective);
    }
    if (replayed != nullptr) {
      const double objective = replayed->number("replay_objective").value_or(0.0);
      objectives.push_back(objective);
      row.set("replay_objective", objective);
      row.set("replay_error", replay_of(*replayed));
    }
    if (const auto indirect = row.number("indirect_objective")) objectives.push_back(*indirect);
    judge(problem, objectives, row);
    return row;
  }

  static void judge(const Problem& problem, const std::vector<double>& objectives, Row& row) {
    const RouteAgreement agreement = agreement_of_routes(objectives, problem.card().reference);
    if (agreement.routes > 1) row.set("agreeing_digits", agreement.digits);
    row.set("confirmed", agreement.confirmed);
    const auto reference = problem.card().reference;
    if (!reference) return;
    row.set("reference", reference->objective);
    row.set("reference_digits", reference->digits);
    row.set("certificate", reference->certificate);
    if (agreement.routes > 0) row.set("reference_agreement", agreement.reference_digits);
    std::vector<std::string> published;
    for (const PublishedOptimum& value : reference->published) {
      published.push_back(fmt::format("{:.12g} ({})", value.objective, value.source));
    }
    row.set("published", fmt::format("{}", fmt::join(published, "; ")));
    row.set("remark", reference->remark);
  }

  std::vector<std::string> route_names_{"gauss3", "lobatto4"};
  bool with_indirect_ = true;
  std::vector<CertifiedProblem> problems_;  // in the order of the cases
  std::optional<ReplayError> replay_;       // this and what follows: of the case that is completed
  std::optional<IndirectSolution> indirect_;
  std::string indirect_message_;
};

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) {
  dmocbench::Certify experiment;
  return dmocbench::run_experiment(experiment, argc, argv);
}
