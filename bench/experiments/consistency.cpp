// Momentum-force consistency over the number of intervals: fig:kepler_J and fig:twolink_obj b) of the paper.
#include <optional>
#include <set>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/run/experiment.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench::consistency_program {

struct Measured {
  std::optional<MomentumConsistency> momentum;
};

class Consistency final : public ExperimentOf<Measured> {
 public:
  Consistency()
      : ExperimentOf(
            {.name = "consistency",
             .description = "Compares the change of momentum with the work of the forces, interval by interval.",
             .options = {.intervals = "16:1024"},
             .compares_tolerances = true}) {}
  [[nodiscard]] Columns<Measured> columns() const override {
    constexpr auto momentum = &Measured::momentum;
    using Result = MomentumConsistency;
    return {
        {"momentum_defect_max", "momentum", "largest defect of an interval", from(momentum, &Result::largest)},
        {"momentum_defect_mean", "momentum", "mean magnitude of the defects", from(momentum, &Result::mean)},
        {"momentum_defect_total", "momentum", "magnitude of the sum of the defects", from(momentum, &Result::total)},
        {"largest_force", "force", "largest force along the symmetry", from(momentum, &Result::largest_force)},
    };
  }
  /// Problems without a symmetry have no momentum to watch and are left out.
  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    std::vector<Case> cases;
    std::set<std::string> left_out;
    for (const std::vector<Case>& curve : curves_of(chosen)) {
      const Problem& problem = *curve.front().problem;
      if (TracedProblem(problem).has_symmetry()) {
        cases.insert(cases.end(), curve.begin(), curve.end());
      } else {
        left_out.insert(problem.name());
      }
    }
    const std::string names = fmt::format("{}", fmt::join(left_out, ", "));
    const char* const state = left_out.size() > 1 ? "state" : "states";
    if (cases.empty()) throw Error("{} {} no symmetry and thus no conserved momentum", names, state);
    if (!left_out.empty()) fmt::print("{} {} no symmetry and thus no conserved momentum; left out\n", names, state);
    return cases;
  }
  void measure(SolvedCase& solved, Measured& measured) override {
    if (solved.trajectory) measured.momentum = momentum_consistency(*solved.the_case.problem, *solved.trajectory);
  }
};

int run(int argc, char** argv) { return run_experiment(Consistency(), argc, argv); }

}  // namespace dmocbench::consistency_program
