// An experiment of one's own: the highest torque beside the cost, on the grids and by the methods of the command line.
#include <dmocbench/experiment.hpp>

namespace {

using namespace dmocbench;

struct Torque final : Experiment {
  Torque()
      : Experiment({.name = "torque",
                    .description = "The highest torque of each method over the number of intervals.",
                    .options = {.intervals = "16:64"}}) {}
  [[nodiscard]] Columns<SolvedCase> columns() const override {
    return {{"highest_torque", "N m", "at the stages", [](const SolvedCase& solved) {
               return solved.trajectory ? Cell(solved.trajectory->stage_u.cwiseAbs().maxCoeff()) : Cell();
             }}};
  }
};

}  // namespace

int main(int argc, char** argv) { return run_experiment(Torque(), argc, argv); }
