// A study of parameters: one problem with other masses, lengths, weights or end states, instance by instance.
#include <map>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiments/sweep/swept_values.hpp"
#include "bench/run/experiment.hpp"
#include "bench/tables/selection.hpp"
#include "methods/error.hpp"

namespace dmocbench::sweep_program {

struct Instance {
  std::size_t number = 0;
  std::vector<double> values;  // of the quantities
};

class Sweep final : public ExperimentOf<Instance> {
 public:
  Sweep()
      : ExperimentOf({.name = "sweep",
                      .description =
                          "Solves a problem for many values of its parameters and end states and writes one row per "
                          "instance. --over gives the values: a grid of all combinations, or the ranges of random "
                          "samples (--samples). With --start common, all instances start from one trajectory of the "
                          "unchanged problem, so that neighbouring instances tend to share a local minimum. With "
                          "--start guess, each instance starts from its own guess, as in Python's solve_batch. The "
                          "two choices may lead to different minima. Failed instances keep their rows.",
                      .options = {.problems = {"two_link_manipulator"},
                                  .methods = {"dmoc"},
                                  .solvers = {"auto"},
                                  .intervals = "64",
                                  .batch = true},
                      .branches = BranchReport::none,
                      .takes_batches = true,
                      .example = "--over mass_1=0.5:2:20 --over final_q1=0.3:0.8:11"}) {}

  void add_options(CommandLine& line) override {
    line.option("--over", over_,
                "NAME=LOWER:UPPER:COUNT: COUNT evenly spaced values of a parameter (shown by `list --problem`) or of "
                "an entry of an end state (initial_q1, initial_v1, final_q1, final_v2, ...); repeat the option to "
                "solve all combinations");
    line.number("--samples", samples_, 0, most_instances,
                "number of random instances, uniformly distributed over each NAME=LOWER:UPPER; 0 selects a grid");
    line.number("--seed", seed_, 0, 0xffffffffU, "seed of the samples; the same seed gives the same instances");
    line.ignored_unless(
        "--seed", [this] { return samples_ > 0; }, "only --samples draws random instances");
  }
  [[nodiscard]] Columns<Instance> columns() const override {
    Columns<Instance> columns{{"instance", "", "number of the instance", &Instance::number, in_key}};
    for (std::size_t i = 0; i < over_.size(); ++i) {
      const std::string name = over_[i].substr(0, over_[i].find('='));
      const auto unit = units_.find(name);
      columns.push_back({name, unit == units_.end() ? "" : unit->second, "value of this quantity",
                         [i](const Instance& instance) { return instance.values.at(i); }});
    }
    return columns;
  }
  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    const std::vector<SweptQuantity> quantities = read_instances();
    std::map<std::shared_ptr<const Problem>, std::vector<std::shared_ptr<const Problem>>> instances;  // of the chosen
    std::vector<Case> cases = vary(chosen, [&](const Case& /*the_case*/) { return numbers_below(instances_.size()); });
    for (Case& the_case : cases) {
      const std::shared_ptr<const Problem> base = the_case.problem;
      for (const Parameter& parameter : base->parameters()) units_[parameter.name] = parameter.unit;
      auto& problems = instances[base];
      if (problems.empty()) {
        require_quantities(*base, quantities);
        for (const std::vector<double>& values : instances_)
          problems.push_back(instance_of(base, card_.options.settings, quantities, values));
      }
      const std::size_t number = the_case.variant.index;
      the_case.problem = problems[number];
      the_case.nominal = base;
      the_case.parameters = parameters_of_instance(*base, quantities, instances_[number]);
      the_case.varied = varied_parameters(*base, quantities);
    }
    return cases;
  }
  void measure(SolvedCase& solved, Instance& instance) override {
    instance.number = solved.the_case.variant.index;
    instance.values = instances_[instance.number];
  }
  void finish(Table& table, FurtherOutput& output) override {
    output.metadata["over"] = over_;
    if (samples_ > 0) output.metadata["seed"] = seed_;
    std::map<std::string, std::size_t> ends;
    for (const Row& row : table.rows()) ++ends[row.text("status")];
    for (const auto& [status, count] : ends)
      output.summary.say(fmt::format("sweep: {} of {} rows: {}", count, table.rows().size(), status));
    const Selection solved = Selection(table).usable().sorted_by("objective");
    if (solved.empty()) return;
    output.summary.say(fmt::format("sweep: the cost ranges from {:.7g} (instance {}) to {:.7g} (instance {})",
                                   solved.front().needed("objective"), solved.front().text("instance"),
                                   solved.back().needed("objective"), solved.back().text("instance")));
    output.summary.say(
        options().start == "guess"
            ? "sweep: each instance started from its own guess; with --start common, instances may end in other minima"
            : "sweep: all instances started from one trajectory; with --start guess, as in Python's solve_batch, they "
              "may end in other minima");
  }

 private:
  /// Makes the instances; returns the quantities that they vary.
  [[nodiscard]] std::vector<SweptQuantity> read_instances() {
    if (over_.empty()) throw Error("a sweep needs --over NAME=LOWER:UPPER:COUNT, a parameter or an end state to vary");
    std::vector<SweptQuantity> quantities;
    quantities.reserve(over_.size());
    for (const std::string& text : over_) quantities.push_back(parse_over(text, samples_ > 0));
    instances_ = instances_of(quantities, samples_ > 0 ? std::optional(samples_) : std::nullopt, seed_);
    return quantities;
  }

  std::vector<std::string> over_;
  std::map<std::string, std::string> units_;  // of the parameters by their names
  long long samples_ = 0;
  std::uint64_t seed_ = 1;
  std::vector<std::vector<double>> instances_;  // the values of the quantities in each
};

int run(int argc, char** argv) { return run_experiment(Sweep(), argc, argv); }

}  // namespace dmocbench::sweep_program
