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

class Consistency final : public Experiment {
 public:
  Consistency()
      : Experiment(
            {.name = "consistency",
             .description = "How well the change of momentum equals the work of the forces, interval by interval.",
             .options = {.intervals = "16:1024"},
             .compares_tolerances = true}) {}
  [[nodiscard]] Columns<SolvedCase> columns() const override {
    using Result = MomentumConsistency;
    return {
        {"momentum_defect_max", "momentum", "largest defect of an interval", of(result_, &Result::largest)},
        {"momentum_defect_mean", "momentum", "mean magnitude of the defects", of(result_, &Result::mean)},
        {"momentum_defect_total", "momentum", "magnitude of their sum", of(result_, &Result::total)},
        {"largest_force", "force", "largest force along the symmetry", of(result_, &Result::largest_force)},
    };
  }
  /// Problems without a symmetry have no momentum to watch and are left out.
  [[nodiscard]] std::vector<Case> variants(const std::vector<Case>& curve) const override {
    const Problem& problem = *curve.front().problem;
    if (TracedProblem(problem).has_symmetry()) return curve;
    left_out_.insert(problem.name());
    return {};
  }
  void check(const std::vector<Case>& cases) override {
    const std::string names = fmt::format("{}", fmt::join(left_out_, ", "));
    const char* const state = left_out_.size() > 1 ? "state" : "states";
    if (cases.empty()) throw Error(fmt::format("{} {} no symmetry, so there is no momentum to watch", names, state));
    if (!left_out_.empty()) fmt::print("{} {} no symmetry, so there is no momentum to watch: left out\n", names, state);
  }
  void complete(SolvedCase& solved) override {
    result_.reset();
    if (solved.trajectory) result_ = momentum_consistency(*solved.the_case.problem, *solved.trajectory);
  }

 private:
  mutable std::set<std::string> left_out_;
  std::optional<MomentumConsistency> result_;
};

int run(int argc, char** argv) { return run_experiment(Consistency(), argc, argv); }

}  // namespace dmocbench::consistency_program
