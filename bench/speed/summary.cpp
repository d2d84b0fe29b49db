#include "bench/speed/summary.hpp"

#include <array>
#include <functional>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "methods/expression/instruction_set.hpp"

namespace dmocbench::speed {

namespace {

using Cell = std::function<std::string(const std::string& problem)>;

std::string line(const std::string& label, const std::vector<std::string>& problems, const Cell& cell) {
  std::string text = fmt::format("{:<34}", label);
  for (const std::string& problem : problems) text += fmt::format("{:>24}", cell(problem));
  return text + "\n";
}

std::string ratio(std::optional<double> numerator, std::optional<double> denominator) {
  return numerator && denominator ? fmt::format("{:.1f}", *numerator / *denominator) : "-";
}

/// ns per interval that the bare tape of the Hessian should stay below on one core with vector instructions.
std::optional<double> target(const std::string& problem) {
  static const std::map<std::string, double> targets{{"orbital_transfer", 15.0}, {"two_link_manipulator", 30.0}};
  const auto found = targets.find(problem);
  return found == targets.end() ? std::nullopt : std::optional(found->second);
}

/// The lines of the table of times: a label and what stands before and behind the problem in a benchmark's name.
struct Line {
  std::string label;
  std::string before;
  std::string behind;
};

std::vector<Line> lines(const std::string& widest) {
  std::vector<Line> all;
  for (const char* quantity : {"hessian", "residual", "jacobian", "separate", "fused"}) {
    for (const InstructionSet set : available_instruction_sets()) {
      const std::string name(name_of(set));
      all.push_back({fmt::format("tape {}, {}", quantity, name), fmt::format("tape/{}/", quantity), "/" + name});
    }
  }
  for (const char* quantity : {"hessian", "residual", "jacobian"}) {
    all.push_back({fmt::format("program {}, {}", quantity, widest), fmt::format("program/{}/", quantity),
                   "/dmoc/gauss_1/" + widest});
  }
  for (const char* quantity : {"hessian", "residual", "jacobian"}) {
    all.push_back({fmt::format("replay {}", quantity), fmt::format("replay/{}/", quantity), ""});
  }
  all.push_back({"ADOL-C hessian, per interval", "adolc/hessian/", ""});
  all.push_back({"ADOL-C hessian, 64 on a tape", "adolc/hessian_block/", ""});
  return all;
}

}  // namespace

std::string summary(const Measurements& measurements, const std::vector<std::string>& problems) {
  const std::string widest(name_of(preferred_instruction_set()));
  const auto hessian_tape = [&](const std::string& problem) { return "tape/hessian/" + problem + "/" + widest; };
  std::string text = "\nns per interval: median (smallest) of the repetitions, in brackets the formulas' operations\n";
  text += line("", problems, [](const std::string& problem) { return problem; });
  for (const Line& what : lines(widest)) {
    text += line(what.label, problems, [&](const std::string& problem) -> std::string {
      const std::string name = what.before + problem + what.behind;
      if (!measurements.median(name)) return "-";
      return fmt::format("{:.1f} ({:.1f}) [{:.0f}]", *measurements.median(name), *measurements.smallest(name),
                         *measurements.operations(name));
    });
  }

  text += fmt::format("\nratios to the bare tape of the Hessian on {}, by medians\n", widest);
  const std::array<std::pair<const char*, const char*>, 3> others{
      {{"replay / tape", "replay/hessian/"},
       {"ADOL-C per interval / tape", "adolc/hessian/"},
       {"ADOL-C 64 on a tape / tape", "adolc/hessian_block/"}}};
  for (const auto& [label, before] : others) {
    text += line(label, problems, [&, start = std::string(before)](const std::string& problem) {
      return ratio(measurements.median(start + problem), measurements.median(hessian_tape(problem)));
    });
  }
  text += line("program / tape", problems, [&](const std::string& problem) {
    return ratio(measurements.median("program/hessian/" + problem + "/dmoc/gauss_1/" + widest),
                 measurements.median(hessian_tape(problem)));
  });

  text += "\ntargets (a missed one fails nothing)\n";
  text += line("tape hessian, " + widest, problems, [&](const std::string& problem) -> std::string {
    const auto measured = measurements.median(hessian_tape(problem));
    const auto limit = target(problem);
    if (!measured || !limit) return "-";
    return fmt::format("{:.1f} < {:.0f}: {}", *measured, *limit, *measured < *limit ? "met" : "missed");
  });
  return text;
}

}  // namespace dmocbench::speed
