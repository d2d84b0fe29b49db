// Takes back the answer of a solver that read a program of write-nl, and judges it as every answer.
#include <fmt/format.h>

#include "bench/extensions/interchange/exchanged_case.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/motion_files.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"
#include "methods/extensions/interchange/ampl_answer.hpp"

namespace dmocbench::read_sol_program {

class ReadSol final : public Experiment {
 public:
  ReadSol()
      : Experiment({.name = "read-sol",
                    .description =
                        "Reads the answer of another solver to a program that write-nl has written with the same "
                        "options, judges it as every answer, and writes its motion: NAME_nodes.csv (t, q, v, p, psi), "
                        "NAME_stages.csv (t, u) and NAME_picture.csv.",
                    .options = {.intervals = "128", .start = "guess"},
                    .takes_parts = false}) {}
  [[nodiscard]] Columns<SolvedCase> columns() const override { return columns_of(checks_); }
  void add_options(CommandLine& line) override {
    line.option("--sol", file_, "FILE.sol, the answer. It is matched to the program by its sizes alone");
  }
  void check(const std::vector<Case>& cases) override {
    const Case& the_case = exchanged_case(cases);
    if (file_.empty()) throw Error("--sol names no file");
    try {
      answer_ = read_ampl_solution(read_file(file_));
      AmplAnswer(*answer_).require_fit(*the_case.transcribe());
    } catch (const Error& error) {
      const std::string reason = error.what();
      if (reason.find(file_) != std::string::npos) throw;
      throw Error(fmt::format("--sol {}: {}", file_, reason));
    }
  }
  void adapt(Case& the_case, Start& /*start*/, SolverOptions& /*options*/) override { the_case.solver = "ampl"; }
  [[nodiscard]] std::unique_ptr<Solver> solver_for(const Case& /*the_case*/, SolverOptions options) override {
    return std::make_unique<AmplAnswer>(*answer_, options);
  }
  void complete(SolvedCase& solved) override {
    if (!answer_->message.empty()) solved.note(fmt::format("Its solver reports: {}", answer_->message));
    checks_ = solved.trajectory ? check_independently(solved) : IndependentChecks{};
    solved_ = solved;
  }
  [[nodiscard]] std::vector<std::string> further_files() const override { return endings_of_motion_files(); }
  void finish(const Table& /*table*/, const std::filesystem::path& prefix, nlohmann::ordered_json& metadata) override {
    if (!is_solved(solved_->solution.status) || !solved_->accuracy) {
      fmt::print("read-sol: {}: {}\n", name_of(solved_->solution.status), solved_->solution.message);
      return;
    }
    write_motion(prefix, *solved_, metadata);
    fmt::print("read-sol: {}: {}_nodes.csv\n", solved_->the_case.label(), prefix.string());
  }

 private:
  std::string file_;
  std::optional<AmplSolution> answer_;
  std::optional<SolvedCase> solved_;
  IndependentChecks checks_;
};

int run(int argc, char** argv) { return run_experiment(ReadSol(), argc, argv); }

}  // namespace dmocbench::read_sol_program
