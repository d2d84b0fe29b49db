// A study of parameters: one problem with other masses, lengths, weights or end states, instance by instance.
#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiments/swept_values.hpp"
#include "bench/run/experiment.hpp"
#include "methods/error.hpp"

namespace dmocbench::sweep_program {

class Sweep final : public Experiment {
 public:
  Sweep()
      : Experiment({.name = "sweep",
                    .description =
                        "Solves a problem with other values of its parameters and end states, a row for each: grids, "
                        "several of them as their product, or random samples. No instance knows of another: all start "
                        "from one motion of the problem as it stands (--start common), or each from its own guess. One "
                        "that is not solved, or cannot be, keeps its row.",
                    .options = {.problems = {"two_link_manipulator"},
                                .methods = {"dmoc"},
                                .solvers = {"interior_point"},
                                .intervals = "64",
                                .batch = true},
                    .tells_branches = false,
                    .cases_stand_alone = true,
                    .takes_batches = true,
                    .finishes_interrupted = true}) {}

  void add_options(CommandLine& line) override {
    line.option("--over", over_,
                "NAME=LOWER:UPPER:COUNT, COUNT values of a parameter (`list --problem` shows them) or of an entry of "
                "an end state (initial_q1, initial_v1, final_q1, final_v2, ...); repeated: every combination");
    line.number("--samples", samples_, 0, most_instances,
                "instances drawn at random, evenly from each NAME=LOWER:UPPER; 0: grids");
    line.number("--seed", seed_, 0, 0xffffffffU, "of the samples; the same seed gives the same instances");
  }
  [[nodiscard]] Columns<SolvedCase> columns() const override {
    Columns<SolvedCase> columns{{"instance", "", "number of the instance",
                                 [](const SolvedCase& solved) { return std::stoul(solved.the_case.variant); }}};
    for (std::size_t i = 0; i < over_.size(); ++i) {
      columns.push_back({over_[i].substr(0, over_[i].find('=')), "", "its value", [this, i](const SolvedCase& solved) {
                           return instances_.at(std::stoul(solved.the_case.variant)).at(i);
                         }});
    }
    return columns;
  }
  [[nodiscard]] std::vector<Case> variants(const std::vector<Case>& curve) const override {
    const std::shared_ptr<const Problem>& base = curve.front().problem;
    if (instances_.empty()) read_instances();
    require_quantities(*base, quantities_);
    auto& problems = problems_[base];
    for (std::size_t i = problems.size(); i < instances_.size(); ++i) {
      problems.push_back(instance_of(base, card_.options.settings, quantities_, instances_[i]));
    }
    const std::vector<std::string> varied = varied_parameters(*base, quantities_);
    std::vector<Case> cases;
    for (std::size_t i = 0; i < instances_.size(); ++i) {
      for (const Case& of_curve : curve) {
        Case instance = of_curve;
        instance.problem = problems[i];
        instance.nominal = base;
        instance.parameters = parameters_of_instance(*base, quantities_, instances_[i]);
        instance.varied = varied;
        instance.variant = std::to_string(i);
        cases.push_back(std::move(instance));
      }
    }
    return cases;
  }
  void finish(const Table& table, const std::filesystem::path& /*prefix*/, nlohmann::ordered_json& metadata) override {
    metadata["over"] = over_;
    if (samples_ > 0) metadata["seed"] = seed_;
    std::map<std::string, std::size_t> ends;
    for (const Row& row : table.rows()) ++ends[row.text("status")];
    for (const auto& [status, count] : ends)
      fmt::print("sweep: {} of {} rows: {}\n", count, table.rows().size(), status);
  }

 private:
  void read_instances() const {
    if (over_.empty()) throw Error("a sweep needs --over NAME=LOWER:UPPER:COUNT, a parameter or an end state to vary");
    for (const std::string& text : over_) quantities_.push_back(parse_over(text, samples_ > 0));
    instances_ = instances_of(quantities_, samples_ > 0 ? std::optional(samples_) : std::nullopt, seed_);
  }

  std::vector<std::string> over_;
  long long samples_ = 0;
  std::uint64_t seed_ = 1;
  // Read from the options when the first cases are made.
  mutable std::vector<SweptQuantity> quantities_;
  mutable std::vector<std::vector<double>> instances_;
  mutable std::map<std::shared_ptr<const Problem>, std::vector<std::shared_ptr<const Problem>>> problems_;
};

int run(int argc, char** argv) { return run_experiment(Sweep(), argc, argv); }

}  // namespace dmocbench::sweep_program
