// Minor iterations and everything else that a solve is counted by: fig:kepler_iterations and fig:twolink_iterations.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/experiment/experiment.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/summary/ratios.hpp"
#include "methods/diagnostics/kkt_fill.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

const std::vector<std::string> crash_names{"none", "basis"};

class Iterations final : public Experiment {
 public:
  [[nodiscard]] std::string name() const override { return "iterations"; }
  [[nodiscard]] std::string description() const override {
    return "Major and minor iterations of the SQP method with the law that predicts them, and the same solves in other "
           "currencies: Ipopt's iterations, SLSQP's evaluations (up to 200 free variables), seconds, entries of the "
           "KKT "
           "matrix and of its factor. NAME_ratios.csv sets collocation against DMOC. Default start: the problem's "
           "guess.";
  }
  [[nodiscard]] std::string default_intervals() const override { return "8:256"; }
  void set_defaults(ExperimentOptions& options) const override {
    options.solvers = {"sqp"};
    options.start = "guess";
    constexpr double tolerance_of_the_study = 1e-8;
    options.tolerance = tolerance_of_the_study;
  }
  [[nodiscard]] std::vector<std::string> own_columns() const override {
    return {"crash",        "phase1_minors",   "phase2_minors", "predicted_minors",
            "kkt_nonzeros", "factor_nonzeros", "evaluations",   "replay_error"};
  }
  void add_options(CommandLine& line) override {
    line.option("--crash", crashes_,
                "first basis of sqp: none (all slacks; phase 1 has to bring every row in), basis (chosen for free)")
        .comma_separated()
        .shows_default();
  }

  [[nodiscard]] std::vector<Case> variants(const std::vector<Case>& curve) const override {
    if (curve.front().solver == "nlopt") return small_grids(curve);
    if (curve.front().solver != "sqp") return curve;
    std::vector<Case> all;
    for (const std::string& crash : crash_names) {
      if (std::find(crashes_.begin(), crashes_.end(), crash) == crashes_.end()) continue;
      for (Case what : curve) {
        what.variant = crash;
        all.push_back(std::move(what));
      }
    }
    return all;
  }
  [[nodiscard]] SolverOptions options_for(const Case& what, SolverOptions common) override {
    if (what.solver == "sqp") common.passed_on["crash"] = what.variant;
    return common;
  }
  void check(const std::vector<Case>& cases) override {
    for (const std::string& crash : crashes_) {
      if (std::find(crash_names.begin(), crash_names.end(), crash) == crash_names.end()) {
        throw Error(fmt::format("--crash takes {}, not {}", fmt::join(crash_names, " or "), crash));
      }
    }
    if (cases.empty()) {
      throw Error(fmt::format("--intervals: no grid is small enough for nlopt; it is left out above {} free variables",
                              most_free_variables_for_slsqp));
    }
  }

  void complete(SolvedCase& solved) override {
    const Case& what = solved.what;
    const Solution& solution = solved.solution;
    Row& row = solved.row;
    row.set("crash", what.variant);
    row.set("phase1_minors", solution.phase_one_minor_iterations);
    row.set("phase2_minors", solution.phase_two_minor_iterations);
    row.set("predicted_minors", predicted(solved));
    row.set("evaluations", solution.total_evaluations());
    const KktFill fill = kkt_fill(
        Transcription(*what.problem, *make_element(what.method), make_tableau(what.tableau, what.stages), what.grid));
    row.set("kkt_nonzeros", static_cast<long long>(fill.nonzeros));
    row.set("factor_nonzeros", static_cast<long long>(fill.factor_nonzeros));
    if (!is_solved(solution.status) || !solved.trajectory) return;
    try {
      row.set("replay_error", replay_error(*what.problem, *solved.trajectory).norm());
    } catch (const Error& error) {
      row.set("message", row.text("message") + " " + error.what());
    }
  }

  void finish(const Table& table, const std::filesystem::path& prefix, nlohmann::ordered_json& /*metadata*/) override {
    write_file(prefix.string() + "_ratios.csv", currency_ratios(table).csv());
  }

 private:
  /// SLSQP is dense: a solve with more free variables takes seconds to minutes and says nothing new.
  static constexpr std::size_t most_free_variables_for_slsqp = 200;

  static std::vector<Case> small_grids(const std::vector<Case>& curve) {
    std::vector<Case> small;
    std::copy_if(curve.begin(), curve.end(), std::back_inserter(small), [](const Case& what) {
      const Transcription program(*what.problem, *make_element(what.method), make_tableau(what.tableau, what.stages),
                                  what.grid);
      return free_variable_count(program) <= most_free_variables_for_slsqp;
    });
    return small;
  }

  /// One minor iteration per free variable from the slack basis, per degree of freedom from a basis chosen for free,
  /// and one per later major iteration (no inequality active); none for other solvers.
  static std::optional<long long> predicted(const SolvedCase& solved) {
    if (!solved.solution.minor_iterations || !solved.solution.major_iterations) return std::nullopt;
    const auto number = [&](const char* column) {
      return static_cast<long long>(solved.row.number(column).value_or(0.0));
    };
    const long long first = number("free_variables") - (solved.what.variant == "basis" ? number("constraints") : 0);
    return first + *solved.solution.major_iterations - 1;
  }

  std::vector<std::string> crashes_{"none"};
};

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) {
  dmocbench::Iterations experiment;
  return dmocbench::run_experiment(experiment, argc, argv);
}
