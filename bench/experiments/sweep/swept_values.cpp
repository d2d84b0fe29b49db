#include "bench/experiments/sweep/swept_values.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "bench/run/options.hpp"
#include "bench/run/restated_problem.hpp"
#include "bench/run/uniform_01.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

/// An entry of an end state by its name: final_v2 is entry 1 of v of the final state.
struct NamedEndEntry {
  bool is_first = true;
  bool is_velocity = false;
  Eigen::Index number = 0;

  [[nodiscard]] double& of(BoundaryState& state) const { return (is_velocity ? state.v : state.q)[number]; }
};

/// Empty if the name has another form.
std::optional<NamedEndEntry> end_entry(std::string_view name) {
  NamedEndEntry entry;
  entry.is_first = name.starts_with("initial_");
  if (!entry.is_first && !name.starts_with("final_")) return std::nullopt;
  name.remove_prefix(name.find('_') + 1);
  if (name.empty() || (name.front() != 'q' && name.front() != 'v')) return std::nullopt;
  entry.is_velocity = name.front() == 'v';
  const auto number = parsed<int>(name.substr(1));
  if (!number || *number < 1) return std::nullopt;
  entry.number = *number - 1;
  return entry;
}

bool has_parameter(const Problem& problem, const std::string& name) {
  return std::ranges::count(problem.parameters(), name, &Parameter::name) > 0;
}

std::vector<std::vector<double>> sampled(const std::vector<SweptQuantity>& quantities, long long samples,
                                         std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<std::vector<double>> instances(static_cast<std::size_t>(samples));
  for (std::vector<double>& values : instances) {
    for (const SweptQuantity& quantity : quantities) {
      values.push_back(quantity.lower + uniform_01(engine) * (quantity.upper - quantity.lower));
    }
  }
  return instances;
}

double on_grid(const SweptQuantity& quantity, int i, int count) {
  if (i + 1 == count) return quantity.upper;
  return quantity.lower + (quantity.upper - quantity.lower) * i / (count - 1);
}

void require_few(double count) {
  if (count <= static_cast<double>(most_instances)) return;
  throw Error("a sweep takes at most {} instances, not {:.0f}; split it into runs with different --name",
              most_instances, count);
}

}  // namespace

SweptQuantity parse_over(const std::string& text, bool is_sampled) {
  const auto [name, range] = parse_assignment("--over", text);
  const std::string option = fmt::format("--over {}", name);
  SweptQuantity quantity{.name = std::string(name)};
  const std::size_t first = range.find(':');
  if (first == std::string_view::npos) {
    throw Error("{} takes LOWER:UPPER:COUNT, or LOWER:UPPER with --samples, got \"{}\"", option, range);
  }
  const std::size_t second = range.find(':', first + 1);
  quantity.lower = parse_number(option, range.substr(0, first));
  quantity.upper =
      parse_number(option, range.substr(first + 1, second == std::string_view::npos ? second : second - first - 1));
  if (!std::isfinite(quantity.lower) || !std::isfinite(quantity.upper) || !(quantity.lower < quantity.upper)) {
    throw Error("{}: the range must be finite and increasing, got {:g} to {:g}", option, quantity.lower,
                quantity.upper);
  }
  const bool has_count = second != std::string_view::npos;
  if (has_count && is_sampled) throw Error("{}: --samples draws the values; omit the count", option);
  if (!has_count && is_sampled) return quantity;
  if (!has_count) throw Error("{}: the count is missing; write LOWER:UPPER:COUNT, or use --samples", option);
  const auto count = parsed<int>(range.substr(second + 1));
  if (!count || *count < 2 || *count > most_instances) {
    throw Error("{}: the count must be a whole number between 2 and {}, got \"{}\"", option, most_instances,
                range.substr(second + 1));
  }
  quantity.count = *count;
  return quantity;
}

std::vector<std::vector<double>> instances_of(const std::vector<SweptQuantity>& quantities,
                                              std::optional<long long> samples, std::uint64_t seed) {
  std::set<std::string> names;
  double product = 1.0;
  for (const SweptQuantity& quantity : quantities) {
    if (!names.insert(quantity.name).second) throw Error("--over {} is given twice", quantity.name);
    product *= quantity.count.value_or(1);
  }
  require_few(samples ? static_cast<double>(*samples) : product);
  if (samples) return sampled(quantities, *samples, seed);
  std::vector<std::vector<double>> instances{{}};
  for (const SweptQuantity& quantity : quantities) {
    const int count = quantity.count.value_or(1);
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& values : instances) {
      for (int i = 0; i < count; ++i) {
        longer.push_back(values);
        longer.back().push_back(on_grid(quantity, i, count));
      }
    }
    instances = std::move(longer);
  }
  return instances;
}

void require_quantities(const Problem& problem, const std::vector<SweptQuantity>& quantities) {
  for (const SweptQuantity& quantity : quantities) {
    if (has_parameter(problem, quantity.name)) continue;
    const auto entry = end_entry(quantity.name);
    if (!entry) {
      static_cast<void>(problem.parameter(quantity.name));  // throws, with the names that there are
      continue;
    }
    if (entry->number >= problem.configuration_size()) {
      throw Error("--over {}: the end states of {} have {} of q and of v", quantity.name, problem.name(),
                  counted(problem.configuration_size(), "entry", "entries"));
    }
    const ProblemBounds bounds = problem.bounds();
    const EndBounds& end = entry->is_first ? bounds.first : bounds.last;
    const Bounds& part = entry->is_velocity ? end.v : end.q;
    if (!part.is_fixed(entry->number)) {
      throw Error("--over {}: {} does not prescribe that entry, so it cannot be varied", quantity.name, problem.name());
    }
  }
}

std::vector<std::string> varied_parameters(const Problem& problem, const std::vector<SweptQuantity>& quantities) {
  std::vector<std::string> names;
  for (const SweptQuantity& quantity : quantities) {
    if (has_parameter(problem, quantity.name)) names.push_back(quantity.name);
  }
  return names;
}

Eigen::VectorXd parameters_of_instance(const Problem& problem, const std::vector<SweptQuantity>& quantities,
                                       const std::vector<double>& values) {
  Eigen::VectorXd parameters = parameter_values(problem);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!has_parameter(problem, quantities[i].name)) continue;
    parameters[static_cast<Eigen::Index>(parameter_number(problem, quantities[i].name))] = values[i];
  }
  return parameters;
}

std::shared_ptr<const Problem> instance_of(const std::shared_ptr<const Problem>& base,
                                           const std::vector<std::string>& settings,
                                           const std::vector<SweptQuantity>& quantities,
                                           const std::vector<double>& values) {
  std::vector<std::string> all_settings;
  for (const std::string& setting : settings) {
    if (has_parameter(*base, std::string(parse_assignment("--set", setting).first))) all_settings.push_back(setting);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!has_parameter(*base, quantities[i].name)) continue;
    all_settings.push_back(fmt::format("{}={:.17g}", quantities[i].name, values[i]));
  }
  const auto with_parameters = selected_problems({base->name()}, all_settings).front();
  RestatedProblem::Changes changes{.cost_scale = base->cost_scale()};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto entry = has_parameter(*base, quantities[i].name) ? std::nullopt : end_entry(quantities[i].name);
    if (!entry) continue;
    std::optional<BoundaryState>& end = entry->is_first ? changes.initial : changes.final;
    if (!end) end = entry->is_first ? with_parameters->initial_state() : with_parameters->final_state();
    entry->of(*end) = values[i];
  }
  return std::make_shared<RestatedProblem>(with_parameters, changes);
}

}  // namespace dmocbench
