// Momentum-force consistency over the number of intervals: fig:kepler_J and fig:twolink_obj b) of the paper.
#include <optional>
#include <set>

#include "bench/experiment/experiment.hpp"
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
  void check(const std::vector<Case>& cases) override {
    std::set<const Problem*> problems;
    for (const Case& the_case : cases) problems.insert(the_case.problem.get());
    for (const Problem* problem : problems) {
      if (TracedProblem(*problem).has_symmetry()) continue;
      throw Error(problem->name() + " states no symmetry, so there is no momentum to watch");
    }
  }
  void complete(SolvedCase& solved) override {
    result_.reset();
    if (solved.trajectory) result_ = momentum_consistency(*solved.the_case.problem, *solved.trajectory);
  }

 private:
  std::optional<MomentumConsistency> result_;
};

int run(int argc, char** argv) { return run_experiment(Consistency(), argc, argv); }

}  // namespace dmocbench::consistency_program
