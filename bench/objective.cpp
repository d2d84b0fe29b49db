// The optimal cost over the number of intervals: fig:twolink_obj a) of the paper.
#include "bench/experiment/experiment.hpp"

namespace dmocbench {

namespace {

class Objective final : public Experiment {
 public:
  [[nodiscard]] std::string name() const override { return "objective"; }
  [[nodiscard]] std::string description() const override {
    return "The optimal cost of each method over the number of intervals.";
  }
  [[nodiscard]] std::string default_intervals() const override { return "16:1024"; }
  [[nodiscard]] std::vector<std::string> own_columns() const override { return {}; }
  void complete(SolvedCase& /*solved*/) override {}
};

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) {
  dmocbench::Objective experiment;
  return dmocbench::run_experiment(experiment, argc, argv);
}
