#include "bench/run/case_list.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/error.hpp"

namespace dmocbench {

std::vector<std::vector<Case>> curves_of(std::span<const Case> cases) {
  std::vector<std::vector<Case>> curves;
  for (const Case& the_case : cases) {
    if (curves.empty() || !curves.back().front().same_curve(the_case)) curves.emplace_back();
    curves.back().push_back(the_case);
  }
  return curves;
}

std::vector<std::string> chosen_of(const std::string& option, const std::vector<std::string>& known,
                                   const std::vector<std::string>& chosen) {
  for (const std::string& name : chosen) {
    if (std::ranges::count(known, name) > 0) continue;
    throw Error("{} takes {}, not {}", option, fmt::join(known, known.size() == 2 ? " or " : ", "), name);
  }
  std::vector<std::string> names;
  std::ranges::copy_if(known, std::back_inserter(names),
                       [&](const std::string& name) { return std::ranges::count(chosen, name) > 0; });
  return names;
}

std::vector<Case> vary(const std::vector<Case>& cases, const LabelsOfCase& labels_of) {
  std::vector<Case> varied;
  for (const std::vector<Case>& curve : curves_of(cases)) {
    const std::vector<std::string> labels = labels_of(curve.front());
    for (std::size_t i = 0; i < labels.size(); ++i) {
      for (const Case& of_curve : curve) varied.emplace_back(of_curve).variant = {i, labels[i]};
    }
  }
  return varied;
}

std::vector<std::string> numbers_below(std::size_t count) {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < count; ++i) labels.push_back(std::to_string(i));
  return labels;
}

std::vector<Case> from_starts(const std::vector<Case>& cases, const std::function<long long(const Case&)>& count_of,
                              const std::function<Motion(const Motion&, const Problem&, std::size_t)>& motion_of) {
  std::vector<Case> started;
  for (const Case& the_case : cases) {
    const auto count = static_cast<std::size_t>(count_of(the_case));
    for (std::size_t i = 0; i < count; ++i) {
      Case& from_start = started.emplace_back(the_case);
      from_start.variant = {i, std::to_string(i)};
      from_start.start = [motion_of, problem = the_case.problem, i](const Motion& chosen) {
        return motion_of(chosen, *problem, i);
      };
    }
  }
  return started;
}

std::size_t reference_of(const std::vector<Case>& curve) {
  const auto found = std::ranges::find(curve, true, &Case::is_reference);
  return found == curve.end() ? 0 : static_cast<std::size_t>(found - curve.begin());
}

std::vector<Case> with_tolerances(const std::vector<Case>& cases, const std::vector<double>& tolerances) {
  if (tolerances.empty()) return cases;
  std::vector<Case> result;
  for (const std::vector<Case>& curve : curves_of(cases)) {
    for (const double tolerance : tolerances) {
      for (const Case& of_curve : curve) result.emplace_back(of_curve).tolerance = tolerance;
    }
  }
  return result;
}

std::vector<CaseSpan> spans_of_problems(const std::vector<Case>& cases, const std::vector<bool>& is_wanted) {
  std::vector<CaseSpan> spans;
  for (std::size_t first = 0, end = 0; first < cases.size(); first = end) {
    bool has_wanted = false;
    for (end = first; end < cases.size() && cases[end].problem == cases[first].problem; ++end) {
      has_wanted = has_wanted || is_wanted[end];
    }
    if (has_wanted) spans.push_back({first, end});
  }
  return spans;
}

std::vector<std::vector<std::size_t>> turns_of(const std::vector<Case>& cases) {
  std::map<std::tuple<std::string, std::string, int, std::size_t>, std::vector<std::size_t>> grids;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    grids[{c.problem->name(), c.tableau, c.stages, c.intervals()}].push_back(i);
  }
  std::vector<std::vector<std::size_t>> turns;
  turns.reserve(grids.size());
  for (auto& [grid, numbers] : grids) turns.push_back(std::move(numbers));
  return turns;
}

std::string label_of_curve(const Case& the_case) {
  const Case& c = the_case;
  return fmt::format("{} {} {} {} {} {} {} {}", c.problem->name(), c.method, c.tableau, c.stages, c.solver,
                     c.derivatives, c.variant.label, c.tolerance.value_or(0.0));
}

}  // namespace dmocbench
