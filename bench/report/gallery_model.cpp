#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "bench/report/model.hpp"
#include "bench/report/words.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "problems/problem_registry.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// Calls `take` for every row of a solve of the problem as it is stated: runs that set parameters have another optimum.
void for_each_solve(const ResultsFolder& results, const std::string& problem,
                    const std::function<void(const Row&)>& take) {
  const auto sets_parameter = [](const std::string& word) {
    return word.starts_with("--set") || word.starts_with("--over");
  };
  for (const auto& [file, run, table] : results.tables) {
    const Json* const metadata = results.metadata_of(run);
    if (metadata == nullptr || file != run + ".csv" || has_columns(table, {"sequence"}) ||
        !has_columns(table, {"problem", "method", "status", "objective"}) ||
        std::ranges::any_of(metadata->at("command_line").get<std::vector<std::string>>(), sets_parameter))
      continue;
    for (const Row& row : table.rows()) {
      if (row.text("problem") == problem) take(row);
    }
  }
}

/// The lowest cost of a problem on the finest grid of all solved rows, since coarse grids may cost less than the
/// optimum; empty if there are none.
std::optional<double> lowest_cost(const ResultsFolder& results, const std::string& problem) {
  std::optional<double> lowest;
  double finest = 0.0;
  for_each_solve(results, problem, [&](const Row& row) {
    const auto cost = row.number("objective");
    if (!cost || is_unsolved(row)) return;
    const double intervals = row.number("intervals").value_or(0.0);
    if (intervals < finest) return;
    lowest = intervals > finest ? *cost : std::min(lowest.value_or(*cost), *cost);
    finest = intervals;
  });
  return lowest;
}

/// One motion per method.
std::vector<const ReportedMotion*> motions_of(const ResultsFolder& results, const std::string& problem) {
  std::vector<const ReportedMotion*> motions;
  for (const ReportedMotion& motion : results.motions) {
    const auto has_method = [&motion](const ReportedMotion* other) { return other->method == motion.method; };
    if (motion.problem == problem && std::ranges::none_of(motions, has_method)) motions.push_back(&motion);
  }
  return motions;
}

/// What is known about the optimum: terms and texts.
Json facts_of(const ProblemCard& card, const std::optional<double>& lowest) {
  Json facts = Json::array();
  const auto add = [&facts](const char* term, const std::string& text) {
    facts.push_back({{"term", term}, {"text", text}});
  };
  if (card.reference) {
    const ReferenceOptimum& reference = *card.reference;
    add("Optimum", fmt::format("{:#.{}g}, {} digits: {}", reference.objective, reference.digits, reference.digits,
                               reference.certificate));
    for (const PublishedOptimum& published : reference.published)
      add("Published", fmt::format("{:.12g}, {}", published.objective, published.source));
  } else {
    add("Optimum", lowest ? fmt::format("not known; the best cost found here is {:.8g}", *lowest) : "not known");
  }
  if (!card.source.empty()) add("Source", card.source);
  return facts;
}

Json problem_model(const Problem& problem, const ResultsFolder& results) {
  const std::string name = problem.name();
  const ProblemCard card = problem.card();
  const auto lowest = lowest_cost(results, name);
  const std::optional<double> optimum = card.reference ? card.reference->objective : lowest;
  return {{"problem", name},
          {"words", in_words(name)},
          {"description", card.description},
          {"motion", motion_model(motions_of(results, name))},
          {"statement", statement_model(problem)},
          {"optimum", optimum ? fmt::format("{:.5g}", *optimum) : ""},
          {"facts", facts_of(card, lowest)},
          {"methods", optimum ? reached_model(results, name, *optimum) : Json::array()}};
}

}  // namespace

PageModel reached_model(const ResultsFolder& results, const std::string& problem, double optimum) {
  // Coarse grids differ by less, other minima by more.
  constexpr double near_enough = 0.01;
  struct Reached {
    std::size_t rows = 0;
    std::size_t solved = 0;
    std::size_t near = 0;
    std::optional<double> smallest;
  };
  std::map<std::string, Reached> methods;
  for_each_solve(results, problem, [&](const Row& row) {
    Reached& reached = methods[row.text("method")];
    ++reached.rows;
    const auto cost = row.number("objective");
    if (!cost || is_unsolved(row)) return;
    ++reached.solved;
    const double difference = std::abs(*cost - optimum) / std::max(std::abs(optimum), 1e-300);
    if (difference <= near_enough) ++reached.near;
    reached.smallest = std::min(reached.smallest.value_or(difference), difference);
  });
  Json model = Json::array();
  for (const auto& [method, reached] : methods) {
    model.push_back({{"method", method},
                     {"words", method_in_words(method)},
                     {"rows", reached.rows},
                     {"solved", reached.solved},
                     {"near", reached.near},
                     {"reaches", reached.near > 0},
                     {"has_mark", method == "dmoc" || method == "hamiltonian" || method == "tangent"},
                     {"difference", reached.smallest ? fmt::format("{:.2g}", *reached.smallest) : ""}});
  }
  return model;
}

PageModel gallery_model(const ResultsFolder& results) {
  if (results.motions.empty()) return {};
  std::size_t others = 0;
  Json problems = Json::array();
  const std::vector<std::string> known = problem_names();
  std::set<std::string> unknown;  // of a library that was not loaded
  for (const ReportedMotion& motion : results.motions) {
    if (std::ranges::count(known, motion.problem) == 0) unknown.insert(motion.problem);
  }
  for (const std::string& name : unknown)
    problems.push_back(
        {{"problem", name}, {"words", in_words(name)}, {"motion", motion_model(motions_of(results, name))}});
  for (const std::string& name : known) {
    if (motions_of(results, name).empty() && !lowest_cost(results, name)) {
      ++others;
    } else {
      problems.push_back(problem_model(*make_problem(name), results));
    }
  }
  return {{"problems", problems}, {"others", others > 0 ? Json(counted(others, "problem")) : Json()}};
}

}  // namespace dmocbench
