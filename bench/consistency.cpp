// Momentum-force consistency over the number of intervals: fig:kepler_J and fig:twolink_obj b) of the paper.
#include "bench/experiment/experiment.hpp"
#include "methods/diagnostics/momentum_consistency.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

namespace {

class Consistency final : public Experiment {
 public:
  [[nodiscard]] std::string name() const override { return "consistency"; }
  [[nodiscard]] std::string description() const override {
    return "How well the change of momentum equals the work of the forces, interval by interval.";
  }
  [[nodiscard]] std::string default_intervals() const override { return "16:1024"; }
  [[nodiscard]] std::vector<std::string> own_columns() const override {
    return {"momentum_defect_max", "momentum_defect_mean", "momentum_defect_total", "largest_force"};
  }
  void check(const std::vector<Case>& cases) override {
    for (const Case& what : cases) {
      if (!TracedProblem(*what.problem).has_symmetry()) {
        throw Error(what.problem->name() + " states no symmetry, so there is no momentum to watch");
      }
    }
  }
  void complete(SolvedCase& solved) override {
    if (!solved.trajectory) return;
    const MomentumConsistency result = momentum_consistency(*solved.what.problem, *solved.trajectory);
    solved.row.set("momentum_defect_max", result.largest);
    solved.row.set("momentum_defect_mean", result.mean);
    solved.row.set("momentum_defect_total", result.total);
    solved.row.set("largest_force", result.largest_force);
  }
};

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) {
  dmocbench::Consistency experiment;
  return dmocbench::run_experiment(experiment, argc, argv);
}
