// One or more solutions, written out as motions: nodes, stages and what a picture shows.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiment/experiment.hpp"
#include "bench/experiment/independent_checks.hpp"
#include "bench/experiment/motion_file.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/experiment/trace_file.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

class Solve final : public Experiment {
 public:
  [[nodiscard]] std::string name() const override { return "solve"; }
  [[nodiscard]] std::string description() const override {
    return "Solves and writes the motion: NAME_nodes.csv (t, q, v, p, psi), NAME_stages.csv (t, u) and "
           "NAME_picture.csv; "
           "with several cases each NAME carries the case's label.";
  }
  [[nodiscard]] std::string default_intervals() const override { return "128"; }
  [[nodiscard]] std::vector<std::string> own_columns() const override { return independent_check_columns(); }
  void add_options(CommandLine& line) override {
    line.option("--trace", trace_file_, "file for every minor iteration of one solve by sqp, a row each");
  }
  void check(const std::vector<Case>& cases) override {
    single_ = cases.size() == 1;
    if (!trace_file_.empty() && (!single_ || cases.front().solver != "sqp")) {
      throw Error("--trace needs exactly one case, solved by --solver sqp");
    }
  }
  [[nodiscard]] SolverOptions options_for(const Case& /*what*/, SolverOptions common) override {
    if (trace_file_.empty()) return common;
    common.on_minor_iteration = [this](const MinorIteration& minor) {
      if (!trace_.empty() && minor.major < trace_.back().major) trace_.clear();  // a repeated solve
      trace_.push_back(minor);
    };
    return common;
  }

  void complete(SolvedCase& solved) override {
    if (!trace_file_.empty()) {
      const auto variables = static_cast<Eigen::Index>(solved.row.number("variables").value_or(0.0));
      write_file(trace_file_, trace_table(trace_, variables).csv());
    }
    if (!solved.trajectory) return;
    check_independently(solved);
    if (!is_solved(solved.solution.status)) return;
    motions_.push_back({solved.what, *solved.trajectory, solved.solution.multipliers_are_estimated});
  }

  void finish(const Table& /*table*/, const std::filesystem::path& prefix, nlohmann::ordered_json& metadata) override {
    for (const auto& [what, trajectory, costates_are_estimated] : motions_) {
      const std::string file = single_ ? prefix.string() : prefix.string() + "_" + what.file_label();
      write_file(file + "_stages.csv", stage_table(*what.problem, trajectory).csv());
      write_file(file + "_picture.csv", picture_table(*what.problem, trajectory).csv());
      write_file(file + "_nodes.csv", node_table(*what.problem, trajectory).csv());
      metadata["motions"].push_back({{"nodes", std::filesystem::path(file + "_nodes.csv").filename().string()},
                                     {"problem", what.problem->name()},
                                     {"method", what.method},
                                     {"tableau", what.tableau},
                                     {"stages", what.stages},
                                     {"intervals", what.intervals()},
                                     {"costates_are_estimated", costates_are_estimated}});
      fmt::print("solve: {}: {}_nodes.csv\n", what.label(), file);
    }
  }

 private:
  struct SolvedMotion {
    Case what;
    Trajectory trajectory;
    bool costates_are_estimated;  // by least squares, where the solver gave no multipliers
  };
  bool single_ = true;
  std::string trace_file_;
  std::vector<MinorIteration> trace_;
  std::vector<SolvedMotion> motions_;
};

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) {
  dmocbench::Solve experiment;
  return dmocbench::run_experiment(experiment, argc, argv);
}
