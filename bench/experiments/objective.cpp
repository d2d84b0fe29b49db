// The optimal cost over the number of intervals: fig:twolink_obj a) of the paper.
#include "bench/run/experiment.hpp"

namespace dmocbench::objective_program {

int run(int argc, char** argv) {
  return run_experiment(Experiment({.name = "objective",
                                    .description = "The optimal cost of each method over the number of intervals.",
                                    .options = {.intervals = "16:1024"}}),
                        argc, argv);
}

}  // namespace dmocbench::objective_program
