// The optimal cost over the number of intervals: fig:twolink_obj a) of the paper.
#include "bench/experiment/experiment.hpp"

int main(int argc, char** argv) {
  return dmocbench::run_experiment(
      dmocbench::Experiment({.name = "objective",
                             .description = "The optimal cost of each method over the number of intervals.",
                             .options = {.intervals = "16:1024"}}),
      argc, argv);
}
