// The least cost of a problem by routes that share as little as possible, compared with the reference that the problem
// states.
#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/run/experiment.hpp"
#include "bench/tables/agreement_of_routes.hpp"
#include "bench/tables/selection.hpp"
#include "methods/error.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench::certify_program {

/// A tableau and its number of stages: "lobatto4" is lobatto with four.
std::pair<std::string, int> parse_route(const std::string& text) {
  const std::size_t digits = text.find_first_of("0123456789");
  if (digits == 0 || digits == std::string::npos || text.size() - digits > 2 ||
      text.find_first_not_of("0123456789", digits) != std::string::npos) {
    throw Error("--routes takes tableaus with their stages, such as gauss3,lobatto4, not {}", text);
  }
  const std::string tableau = text.substr(0, digits);
  if (text[digits] == '0') throw Error("--routes: {} has a leading 0; write gauss3", text);
  const int stages = std::stoi(text.substr(digits));
  static_cast<void>(make_tableau(tableau, stages));  // throws if it is not offered
  return {tableau, stages};
}

/// The least cost of a problem by all routes.
struct Certificate {
  std::string problem;
  std::map<std::string, double> objectives;  ///< by route
  std::optional<double> replay_objective;
  std::optional<double> relative_jump;
  std::optional<double> replay_error;
  std::optional<double> indirect_objective;
  std::optional<double> indirect_digits;
  std::optional<int> grid_digits;
  RouteAgreement agreement;
  std::optional<ReferenceOptimum> reference;
  std::string message;
};

/// The finest answer of every route, the cost of the answer on the finest grid whose intervals join best, replayed one
/// by one, and the indirect method's cost, from the rows of one problem.
Certificate certificate_of(const Problem& problem, const Table& table) {
  const Selection rows = Selection(table).where("problem", problem.name());
  const auto has_message = [](const Row& row) { return !row.text("indirect_message").empty(); };
  const Selection solved = rows.where(has_solved_status).with_number("objective").sorted_by("intervals");
  const Selection replays = solved.with_number("replay_objective");
  const Row& best_replay =
      replays.where("intervals", replays.back().text("intervals")).sorted_by("relative_jump").front();
  Certificate result{.problem = problem.name(),
                     .objectives = {},
                     .replay_objective = best_replay.number("replay_objective"),
                     .relative_jump = best_replay.number("relative_jump"),
                     .replay_error = best_replay.number("replay_error"),
                     .indirect_objective = rows.with_number("indirect_objective").back().number("indirect_objective"),
                     .indirect_digits = rows.with_number("indirect_digits").back().number("indirect_digits"),
                     .grid_digits = std::nullopt,
                     .agreement = {},
                     .reference = problem.card().reference,
                     .message = rows.where(has_message).back().text("indirect_message")};
  std::map<std::string, double> coarser;  // on the grid before the finest, by route
  for (const Row& row : solved) {         // the finest grid comes last
    const double objective = *row.number("objective");
    const auto [route, is_first] = result.objectives.try_emplace(row.text("tableau") + row.text("stages"), objective);
    if (is_first) continue;
    coarser[route->first] = std::exchange(route->second, objective);
  }
  for (const auto& [route, objective] : coarser) {
    const int digits = agreeing_digits(objective, result.objectives.at(route));
    result.grid_digits = std::min(digits, result.grid_digits.value_or(digits));
  }
  std::vector<double> costs;
  costs.reserve(result.objectives.size() + 2);
  for (const auto& [route, objective] : result.objectives) costs.push_back(objective);
  for (const auto& cost : {result.replay_objective, result.indirect_objective}) {
    if (cost) costs.push_back(*cost);
  }
  result.agreement = agreement_of_routes(costs, result.reference, result.grid_digits);
  return result;
}

auto agreeing_digits(const Certificate& certificate) {
  return certificate.agreement.routes > 1 ? std::optional(certificate.agreement.digits) : std::nullopt;
}

auto reference_agreement(const Certificate& certificate) {
  const bool is_known = certificate.reference && certificate.agreement.routes > 0;
  return is_known ? std::optional(certificate.agreement.reference_digits) : std::nullopt;
}

std::string published(const Certificate& certificate) {
  if (!certificate.reference) return {};
  const auto in_words = [](const PublishedOptimum& p) { return fmt::format("{:.12g} ({})", p.objective, p.source); };
  return fmt::format("{}", fmt::join(certificate.reference->published | std::views::transform(in_words), "; "));
}

Columns<Certificate> certificate_columns(const std::vector<std::string>& routes) {
  constexpr auto reference = &Certificate::reference;
  Columns<Certificate> columns{{"problem", "", "name of the problem", from(&Certificate::problem), in_key}};
  for (const std::string& route : routes) {
    columns.push_back({route + "_objective", "cost", "cost on the finest grid", [route](const Certificate& c) {
                         const auto found = c.objectives.find(route);
                         return found == c.objectives.end() ? std::nullopt : std::optional(found->second);
                       }});
  }
  return columns +
         Columns<Certificate>{
             {"replay_objective", "cost",
              "cost of the solution with the smallest jumps, computed by integrating interval by interval",
              from(&Certificate::replay_objective)},
             {"relative_jump", "", "largest jump between integrated intervals of this solution, relative to the range",
              from(&Certificate::relative_jump)},
             {"replay_error", "", "distance from the final state after a replay of the whole horizon",
              from(&Certificate::replay_error)},
             {"indirect_objective", "cost", "cost of the indirect solution", from(&Certificate::indirect_objective)},
             {"indirect_digits", "", "certified digits of the indirect cost", from(&Certificate::indirect_digits)},
             {"agreeing_digits", "", "digits on which all routes agree", agreeing_digits},
             {"grid_digits", "", "digits on which each route's two finest grids agree",
              from(&Certificate::grid_digits)},
             {"reference", "cost", "the problem's reference cost", from(reference, &ReferenceOptimum::objective)},
             {"reference_digits", "", "valid digits of the reference cost", from(reference, &ReferenceOptimum::digits)},
             {"certificate", "", "method used for the reference cost", from(reference, &ReferenceOptimum::certificate)},
             {"reference_agreement", "", "digits on which all routes agree with the reference", reference_agreement},
             {"confirmed", "", "verdict of the routes on the reference cost",
              from(&Certificate::agreement, &RouteAgreement::confirmed)},
             {"published", "", "published values with their sources", published},
             {"remark", "", "reason why published values differ", from(reference, &ReferenceOptimum::remark)},
             {"message", "", "reason for a missing indirect solution", from(&Certificate::message)}};
}

/// The cost of a solved case, replayed interval by interval; empty, with the reason in the row's message, if that
/// fails.
std::optional<double> replayed_objective(SolvedCase& solved, const Trajectory& motion) {
  try {
    return cost_by_intervals(*solved.the_case.problem, motion);
  } catch (const Error& error) {
    solved.note(error.what());
    return std::nullopt;
  }
}

struct Measured {
  std::optional<ReplayError> replay;
  std::optional<double> replay_objective;
  std::optional<int> polish_steps;
  std::optional<IndirectSolution> indirect;
  std::string indirect_message;
};

std::string reference_in_words(const std::string& confirmed) {
  if (confirmed.empty()) return "unknown for these parameter values";
  return confirmed == "yes" ? "confirmed" : confirmed == "no" ? "not confirmed" : "confirmed " + confirmed;
}

class Certify final : public ExperimentOf<Measured> {
 public:
  // Digits are wanted that end where the solver's tolerance begins, so answers are polished.
  Certify()
      : ExperimentOf(
            {.name = "certify",
             .description = "Computes the optimal cost with independent methods (routes): two tableaus on two grids "
                            "each, integration of every interval of the finest solution, and the indirect method where "
                            "it applies. NAME_references.csv has a row per problem with the costs, the number of "
                            "digits on which they agree, and the verdict on the problem's reference cost.",
             .options = {.problems = {"all"}, .methods = {"dmoc"}, .solvers = {"ipopt"}, .intervals = "64,128"},
             .further_files = {"_references.csv"},
             .problems_are_independent = true,
             .polishes = true}) {}
  [[nodiscard]] Columns<Measured> columns() const override {
    return {
        replay_error_column(&Measured::replay),
        {"replay_objective", "cost", "cost of the trajectory, computed by integrating interval by interval",
         &Measured::replay_objective},
        {"polish_steps", "", "number of Newton steps after the solve", &Measured::polish_steps},
        {"indirect_objective", "cost", "cost of the indirect solution",
         from(&Measured::indirect, &IndirectSolution::cost)},
        {"indirect_digits", "", "certified digits of the indirect cost",
         from(&Measured::indirect, &IndirectSolution::certified_digits)},
        {"indirect_message", "", "reason for a missing indirect solution", &Measured::indirect_message},
    };
  }
  void add_options(CommandLine& line) override {
    line.list("--routes", route_names_, "tableaus with their stages, such as gauss3; replaces --tableau and --stages");
    for (const char* const option : {"--tableau", "--stages"})
      line.ignored_unless(
          option, [] { return false; }, "--routes replaces it");
    line.flag("!--no-indirect", with_indirect_, "do not run the indirect method");
  }
  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    std::vector<std::pair<std::string, int>> routes;
    std::ranges::transform(route_names_, std::back_inserter(routes), parse_route);
    for (const std::string& route : route_names_) {
      if (std::ranges::count(route_names_, route) == 1) continue;
      throw Error("--routes: {} is given twice; each route must be different", route);
    }
    std::vector<Case> cases;
    for (const std::vector<Case>& curve : curves_of(chosen)) {
      if (problems_.empty() || problems_.back().problem != curve.front().problem)
        problems_.push_back({curve.front().problem});
      problems_.back().cases_left += routes.size() * curve.size();
      for (const auto& [tableau, stages] : routes) {
        for (const Case& of_curve : curve) {
          Case& the_case = cases.emplace_back(of_curve);
          the_case.tableau = tableau;
          the_case.stages = stages;
          the_case.shares = the_case.problem->name();
        }
      }
    }
    return cases;
  }

  /// The indirect method starts at an answer and follows the last of a problem's cases, in that row.
  void measure(SolvedCase& solved, Measured& measured) override {
    measured.polish_steps = solved.polish_steps;
    ProblemToCertify& certified = *std::ranges::find(problems_, solved.the_case.problem, &ProblemToCertify::problem);
    if (solved.trajectory && is_solved(solved.solution.status)) {
      measured.replay = replay(solved);
      measured.replay_objective = replayed_objective(solved, *solved.trajectory);
      auto& finest = certified.finest;
      if (!finest || finest->intervals() < solved.trajectory->intervals()) finest = solved.trajectory;
    }
    if (--certified.cases_left > 0 || !with_indirect_ || !certified.finest) return;
    try {
      measured.indirect = solve_indirect(*certified.problem, *certified.finest);
    } catch (const Error& error) {  // the method does not cover all problems
      measured.indirect_message = error.what();
    }
  }

  void finish(Table& table, FurtherOutput& output) override {
    std::vector<Certificate> certificates;
    for (const ProblemToCertify& certified : problems_) {
      const Certificate& c = certificates.emplace_back(certificate_of(*certified.problem, table));
      output.summary.say(fmt::format("certify: {}: all routes agree to {} digits; reference {}", c.problem,
                                     Cell(agreeing_digits(c)).text(), reference_in_words(c.agreement.confirmed)));
    }
    output.write("_references.csv", table_of(certificate_columns(route_names_), certificates));
  }

 private:
  struct ProblemToCertify {
    std::shared_ptr<const Problem> problem;
    std::size_t cases_left = 0;
    std::optional<Trajectory> finest = std::nullopt;  // the first answer on the finest grid so far
  };

  std::vector<std::string> route_names_{"gauss3", "lobatto4"};
  bool with_indirect_ = true;
  std::vector<ProblemToCertify> problems_;  // in the order of the cases
};

int run(int argc, char** argv) { return run_experiment(Certify(), argc, argv); }

}  // namespace dmocbench::certify_program
