// An experiment of one's own: the highest torque beside the cost, on the grids and by the methods of the command line.
#include <dmocbench/experiment.hpp>

namespace {

using namespace dmocbench;

std::optional<double> highest_torque(const SolvedCase& solved) {
  if (!solved.trajectory) return {};
  return solved.trajectory->stage_u.cwiseAbs().maxCoeff();
}

}  // namespace

int main(int argc, char** argv) {
  return run_experiment(Experiment({.name = "torque",
                                    .description = "The highest torque of each method over the number of intervals.",
                                    .options = {.intervals = "16:64"}},
                                   {{"highest_torque", "N m", "at the stages", highest_torque}}),
                        argc, argv);
}
