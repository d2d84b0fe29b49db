// Minor iterations and everything else that a solve is counted by: fig:kepler_iterations and fig:twolink_iterations.
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bench/run/experiment.hpp"
#include "bench/run/meanings.hpp"
#include "bench/tables/ratios.hpp"
#include "methods/diagnostics/kkt_fill.hpp"
#include "methods/error.hpp"
#include "methods/solvers/sqp/sqp_solver.hpp"

namespace dmocbench::iterations_program {

class Iterations final : public Experiment {
 public:
  Iterations()
      : Experiment({.name = "iterations",
                    .description =
                        "Major and minor iterations of the SQP method with the law that predicts them, and the same "
                        "solves in other currencies: Ipopt's iterations, SLSQP's evaluations (up to 200 free "
                        "variables), seconds, entries of the KKT matrix and of its factor. NAME_ratios.csv sets "
                        "collocation against DMOC. Default start: the problem's guess.",
                    .options = {.solvers = {"sqp"}, .intervals = "8:256", .start = "guess", .tolerance = 1e-8},
                    .tells_branches_from_guess = true,
                    .takes_turns = true,
                    .compares_tolerances = true}) {}
  [[nodiscard]] Columns<SolvedCase> columns() const override {
    constexpr auto solution = &SolvedCase::solution;
    return {
        {"crash", "", "first basis of sqp: none or basis", from(&SolvedCase::the_case, &Case::variant)},
        {"phase1_minors", "", "minor iterations of phase 1", from(solution, &Solution::phase_one_minor_iterations)},
        {"phase2_minors", "", "minor iterations of phase 2", from(solution, &Solution::phase_two_minor_iterations)},
        {"predicted_minors", "", "minor iterations by the law that counts variables and iterations", predicted},
        {"kkt_nonzeros", "", "entries of the KKT matrix, lower triangle", of(fill_, &KktFill::nonzeros)},
        {"factor_nonzeros", "", "entries of its factor", of(fill_, &KktFill::factor_nonzeros)},
        {"evaluations", "", "calls of the cost, the constraints and their derivatives by the solver",
         from(solution, &Solution::total_evaluations)},
        replay_error_column(replay_),
    };
  }
  void add_options(CommandLine& line) override {
    line.list("--crash", crashes_,
              "first basis of sqp: none (all slacks; phase 1 has to bring every row in), basis (chosen for free)");
  }

  [[nodiscard]] std::vector<Case> variants(const std::vector<Case>& curve) const override {
    const std::vector<std::string> crashes = chosen_of("--crash", {"none", "basis"}, crashes_);
    std::vector<Case> cases = curve.front().solver == "sqp" ? vary(curve, crashes) : curve;
    std::erase_if(cases, [](const Case& the_case) {
      return the_case.solver == "nlopt" && free_variable_count(*the_case.transcribe()) > most_free_variables_for_slsqp;
    });
    return cases;
  }
  [[nodiscard]] std::unique_ptr<Solver> solver_for(const Case& the_case, SolverOptions options) override {
    if (the_case.solver != "sqp") return Experiment::solver_for(the_case, options);
    SequentialOptions choices = sequential_options(named_options(this->options()));
    choices.crash = crash_named(the_case.variant);
    return std::make_unique<SqpSolver>(options, std::move(choices));
  }
  void check(const std::vector<Case>& cases) override {
    if (!cases.empty()) return;
    throw Error(fmt::format("--intervals: no grid is small enough for nlopt; it is left out above {} free variables",
                            most_free_variables_for_slsqp));
  }

  void complete(SolvedCase& solved) override {
    fill_ = kkt_fill(solved.program ? *solved.program : *solved.the_case.transcribe());
    replay_ = is_solved(solved.solution.status) && solved.trajectory ? replay(solved) : std::nullopt;
  }

  [[nodiscard]] std::vector<std::string> further_files() const override { return {"_ratios.csv"}; }
  void finish(const Table& table, const std::filesystem::path& prefix, nlohmann::ordered_json& metadata) override {
    write_table(prefix.string() + "_ratios.csv", currency_ratios(table), metadata);
  }

 private:
  /// SLSQP is dense: a solve with more free variables takes seconds to minutes and says nothing new.
  static constexpr std::size_t most_free_variables_for_slsqp = 200;

  /// One minor iteration per free variable from the slack basis, per degree of freedom from a basis chosen for free,
  /// and one per later major iteration (no inequality active); none for other solvers.
  static std::optional<long long> predicted(const SolvedCase& solved) {
    const Solution& solution = solved.solution;
    if (!solution.minor_iterations || !solution.major_iterations) return {};
    const auto free_variables = static_cast<long long>(free_variable_count(*solved.program));
    const auto constraints = static_cast<long long>(solved.program->constraint_count());
    const bool from_a_basis = solved.the_case.variant == "basis";
    return free_variables - (from_a_basis ? constraints : 0) + *solution.major_iterations - 1;
  }

  std::vector<std::string> crashes_{"none"};
  KktFill fill_;                       // of the case that is completed
  std::optional<ReplayError> replay_;  // likewise
};

int run(int argc, char** argv) { return run_experiment(Iterations(), argc, argv); }

}  // namespace dmocbench::iterations_program
