// The optimal cost over the number of intervals: fig:twolink_obj a) of the paper.
#include "bench/experiment/experiment.hpp"

namespace dmocbench {

namespace {

class Objective final : public Experiment {
 public:
  Objective()
      : Experiment({.name = "objective",
                    .description = "The optimal cost of each method over the number of intervals.",
                    .options = {.intervals = "16:1024"}}) {}
};

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) {
  dmocbench::Objective experiment;
  return dmocbench::run_experiment(experiment, argc, argv);
}
