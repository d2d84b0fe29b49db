#include "bench/run/run_plan.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/result_file.hpp"
#include "bench/run/row_store.hpp"
#include "methods/error.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// A number of digits alone: no sign, no blank.
std::optional<std::size_t> parse_digits(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  return parsed<std::size_t>(text);
}

/// The first case of a case's group; shortens the way there.
std::size_t first_of_group(std::vector<std::size_t>& groups, std::size_t number) {
  while (groups[number] != number) number = groups[number] = groups[groups[number]];
  return number;
}

std::string scheme_of(const Case& c) { return fmt::format("{} {} {}", c.problem->name(), c.tableau, c.stages); }

Json parameters_of(const std::vector<Case>& cases) {
  Json parameters = Json::object();
  for (const Case& the_case : cases) {
    const std::string& name = the_case.problem->name();
    if (parameters.contains(name)) continue;
    parameters[name] = Json::object();
    for (const Parameter& parameter : the_case.problem->parameters())
      parameters[name][parameter.name] = parameter.value;
  }
  return parameters;
}

/// Of names, grids, tolerances and parameters of all cases.
std::string checksum_of_cases(const std::vector<Case>& cases) {
  std::string checksum;
  for (const Case& the_case : cases) {
    std::string text = fmt::format("{} {} {}", checksum, the_case.label(), the_case.tolerance.value_or(0.0));
    for (const Parameter& parameter : the_case.problem->parameters()) text += fmt::format(" {}", parameter.value);
    const Eigen::VectorXd times = the_case.grid.relative_times();
    text.append(reinterpret_cast<const char*>(times.data()),  // NOLINT(*-reinterpret-cast): bytes
                static_cast<std::size_t>(times.size()) * sizeof(double));
    checksum = checksum_of(text);
  }
  return checksum;
}

}  // namespace

std::string Part::in_words() const { return fmt::format("{}/{}", number, of); }

std::string Part::name() const { return fmt::format("{:0{}}-of-{}", number, fmt::formatted_size("{}", of), of); }

Part parse_part(std::string_view option, std::string_view text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto number = parse_digits(text.substr(0, slash));
  const auto of = parse_digits(text.substr(std::min(slash + 1, text.size())));
  if (number && of && *number >= 1 && *number <= *of && *of <= most_parts_of_a_run) return {*number, *of};
  constexpr std::size_t most_shown = 40;
  throw Error("{} takes i/n (part i of n, 1 <= i <= n <= {}), as in 3/16, not \"{}\"{}", option, most_parts_of_a_run,
              text.substr(0, most_shown), text.size() > most_shown ? " ..." : "");
}

std::vector<std::size_t> groups_of(const std::vector<Case>& cases, const std::vector<SharedBy>& respects) {
  std::vector<std::size_t> groups(cases.size());
  std::iota(groups.begin(), groups.end(), 0U);
  for (const SharedBy& shared_by : respects) {
    std::unordered_map<std::string, std::size_t> first_with;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const std::string words = shared_by(cases[i]);
      if (words.empty()) continue;
      const std::size_t here = first_of_group(groups, i);
      const std::size_t there = first_of_group(groups, first_with.try_emplace(words, i).first->second);
      groups[std::max(here, there)] = std::min(here, there);
    }
  }
  for (std::size_t i = 0; i < cases.size(); ++i) groups[i] = first_of_group(groups, i);
  return groups;
}

std::vector<std::size_t> dealt_out(const std::vector<Case>& cases, const std::vector<std::size_t>& groups,
                                   std::size_t parts) {
  std::vector<std::pair<std::string, std::size_t>> order;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (groups[i] == i) order.emplace_back(checksum_of(fmt::format("{} {}", cases[i].label(), i)), i);
  }
  std::ranges::sort(order);
  std::vector<std::size_t> part_of(cases.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank) part_of[order[rank].second] = rank % parts + 1;
  for (std::size_t i = 0; i < cases.size(); ++i) part_of[i] = part_of[groups[i]];
  return part_of;
}

std::filesystem::path folder_of_parts(const std::filesystem::path& folder, const std::string& name) {
  return folder / (name + ".parts");
}

RunPlan::RunPlan(Experiment& experiment)
    : card_(experiment.card()),
      cases_(with_tolerances(experiment.cases(expand_cases(card_.options)), chosen_tolerances(card_.options))),
      prefix_(card_.options.out / card_.options.name),
      wanted_(cases_.size(), true) {
  const ExperimentOptions& options = card_.options;
  if (options.part.empty()) return;
  part_ = parse_part("--part", options.part);
  prefix_ = folder_of_parts(options.out, options.name) / part_->name();
  const std::vector<std::size_t> part_of = dealt_out(cases_, groups_of_starts(), part_->of);
  for (std::size_t i = 0; i < cases_.size(); ++i) wanted_[i] = part_of[i] == part_->number;
}

std::size_t RunPlan::wanted_count() const { return static_cast<std::size_t>(std::ranges::count(wanted_, true)); }

std::vector<SharedBy> RunPlan::respects_of_rows() const {
  std::vector<SharedBy> respects{[](const Case& the_case) { return the_case.shares; }};
  if (card_.takes_turns)
    respects.emplace_back([](const Case& c) { return fmt::format("{} {}", scheme_of(c), c.intervals()); });
  return respects;
}

std::vector<std::size_t> RunPlan::groups_of_rows() const { return groups_of(cases_, respects_of_rows()); }

std::vector<std::size_t> RunPlan::groups_of_starts() const {
  std::vector<SharedBy> respects = respects_of_rows();
  const std::string& start = card_.options.start;
  if (start == "common" || (start == "guess" && card_.branches == BranchReport::of_any_start))
    respects.emplace_back(scheme_of);
  return groups_of(cases_, respects);
}

Json RunPlan::identity(const Json& metadata, const std::map<std::string, std::string>& options,
                       const std::vector<std::string>& columns) const {
  Json identity = identity_of(card_.name, metadata, options, parameters_of(cases_));
  const std::string& start = card_.options.start;
  std::error_code none;  // a start that is not a file is rejected where it is read
  if (start != "common" && start != "guess" && std::filesystem::is_regular_file(start, none))
    identity["start"] = checksum_of(read_file(start));
  identity["cases"] = cases_.size();
  identity["checksum_of_cases"] = checksum_of_cases(cases_);
  identity["columns"] = columns;
  return identity;
}

void RunPlan::describe(Json& metadata) const {
  metadata["start"] = card_.options.start;
  if (card_.options.tolerances.empty()) metadata["tolerance"] = card_.options.tolerance;
  metadata["repeats"] = card_.options.repeats;
  for (const Case& the_case : cases_) {
    const Problem& problem = *the_case.problem;
    Json& scale = metadata["cost_scale"][problem.name()];
    if (!scale.is_null()) continue;
    scale = problem.cost_scale();
    const ProblemCard card = problem.card();
    if (card.configuration_units.empty() && card.control_units.empty()) continue;
    metadata["units"][problem.name()] = {{"configurations", card.configuration_units},
                                         {"controls", card.control_units}};
  }
}

}  // namespace dmocbench
