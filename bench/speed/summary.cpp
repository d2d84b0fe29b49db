#include "bench/speed/summary.hpp"

#include <functional>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "bench/speed/benchmarks.hpp"
#include "methods/runtime/instruction_set.hpp"

namespace dmocbench::speed {

namespace {

using Cell = std::function<std::string(const std::string& problem)>;

std::string line(const std::string& label, const std::vector<std::string>& problems, const Cell& cell) {
  std::string text = fmt::format("{:<34}", label);
  for (const std::string& problem : problems) text += fmt::format("{:>28}", cell(problem));
  return text + "\n";
}

/// What stands before and behind the problem in a benchmark's name.
struct Place {
  std::string before;
  std::string behind;
  [[nodiscard]] std::string name(const std::string& problem) const { return before + problem + behind; }
};

struct Line {
  std::string label;
  Place place;
};

std::vector<Line> lines(const std::string& widest) {
  std::vector<Line> all;
  for (const char* way : {"tape", "hand"}) {
    for (const char* quantity : {"hessian", "residual", "jacobian", "separate", "fused"}) {
      if (std::string(way) == "hand" && std::string(quantity) == "fused") continue;
      for (const InstructionSet set : available_instruction_sets()) {
        all.push_back({fmt::format("{} {}, {}", way, quantity, name_of(set)),
                       {fmt::format("{}/{}/", way, quantity), fmt::format("/{}", name_of(set))}});
      }
    }
  }
  for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
    for (const char* quantity : {"hessian", "residual", "jacobian", "separate"}) {
      all.push_back({fmt::format("program {}, {}", quantity, method),
                     {fmt::format("program/{}/", quantity), fmt::format("/{}/gauss_1/{}", method, widest)}});
    }
  }
  for (const char* quantity : {"hessian", "residual", "jacobian"}) {
    all.push_back({fmt::format("replay {}", quantity), {fmt::format("replay/{}/", quantity), ""}});
  }
  all.push_back({"ADOL-C hessian, per interval", {"adolc/hessian/", ""}});
  all.push_back({"ADOL-C hessian, 64 on a tape", {"adolc/hessian_block/", ""}});
  return all;
}

/// A quotient of two Hessians' times, and what it should be.
struct Ratio {
  std::string label;
  Place numerator;
  Place denominator;
  std::optional<double> at_most = {};
  std::optional<double> at_least = {};
};

std::string verdict(bool met) { return met ? "met" : "missed"; }

}  // namespace

std::string summary(const Measurements& measurements, const std::vector<std::string>& problems) {
  const std::string widest(name_of(preferred_instruction_set()));
  const auto median = [&](const Place& place, const std::string& problem) {
    return measurements.median(place.name(problem), ns_per_interval);
  };
  std::string text = "\nns per interval: median (smallest) of the repetitions, in brackets the formulas' operations\n";
  text += line("", problems, [](const std::string& problem) { return problem; });
  for (const auto& [label, place] : lines(widest)) {
    text += line(label, problems, [&, &where = place](const std::string& problem) -> std::string {
      const auto typical = median(where, problem);
      if (!typical) return "-";
      return fmt::format("{:.1f} ({:.1f}) [{:.0f}]", *typical,
                         measurements.smallest(where.name(problem), ns_per_interval).value_or(*typical),
                         measurements.median(where.name(problem), operations_per_interval).value_or(0.0));
    });
  }

  const Place tape{"tape/hessian/", "/" + widest};
  const Place program{"program/hessian/", "/dmoc/gauss_1/" + widest};
  const Place hand{"hand/hessian/", "/" + widest};
  const Place replay{"replay/hessian/", ""};
  const Place adolc{"adolc/hessian/", ""};
  const Place adolc_block{"adolc/hessian_block/", ""};
  text +=
      fmt::format("\nratios of Hessians on {}, by medians, with their targets (a missed one fails nothing)\n", widest);
  constexpr double close = 1.5;
  constexpr double far = 15.0;
  for (const Ratio& ratio : {Ratio{"tape / hand", tape, hand, close, {}},
                             {"program / hand", program, hand, close, {}},
                             {"program / tape", program, tape, {}, {}},
                             {"replay / tape", replay, tape, {}, {}},
                             {"ADOL-C per interval / program", adolc, program, {}, far},
                             {"ADOL-C 64 on a tape / program", adolc_block, program, {}, far}}) {
    text += line(ratio.label, problems, [&](const std::string& problem) -> std::string {
      const auto numerator = median(ratio.numerator, problem);
      const auto denominator = median(ratio.denominator, problem);
      if (!numerator || !denominator) return "-";
      const double value = *numerator / *denominator;
      if (ratio.at_most) return fmt::format("{:.1f} < {}: {}", value, *ratio.at_most, verdict(value < *ratio.at_most));
      if (ratio.at_least)
        return fmt::format("{:.0f} > {}: {}", value, *ratio.at_least, verdict(value > *ratio.at_least));
      return fmt::format("{:.1f}", value);
    });
  }
  // ns per interval that the program's Hessian should stay below on one core with vector instructions.
  static const std::map<std::string, double> targets{{"orbital_transfer", 10.0}, {"two_link_manipulator", 20.0}};
  text += line("program hessian, dmoc [ns]", problems, [&](const std::string& problem) -> std::string {
    const auto measured = median(program, problem);
    const auto target = targets.find(problem);
    if (!measured || target == targets.end()) return "-";
    return fmt::format("{:.1f} < {:.0f}: {}", *measured, target->second, verdict(*measured < target->second));
  });
  return text;
}

}  // namespace dmocbench::speed
