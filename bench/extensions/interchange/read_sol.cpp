// Reads the solution that another solver found for a program of write-nl, and checks it like every solution.
#include <fmt/format.h>

#include "bench/extensions/interchange/exchanged_case.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/motion_files.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"
#include "methods/extensions/interchange/ampl_answer.hpp"

namespace dmocbench::read_sol_program {

class ReadSol final : public ExperimentOf<IndependentChecks> {
 public:
  ReadSol()
      : ExperimentOf({.name = "read-sol",
                      .description = "Reads the solution that another solver found for a program of write-nl (with the "
                                     "same options), judges it like any other solution, and writes its trajectory: "
                                     "NAME_nodes.csv (t, q, v, p, psi), NAME_stages.csv (t, u) and NAME_picture.csv.",
                      .options = {.intervals = "128", .start = "guess"},
                      .further_files = endings_of_motion_files(),
                      .rows = RowUse::motions}) {}
  [[nodiscard]] Columns<IndependentChecks> columns() const override { return check_columns(); }
  void add_options(CommandLine& line) override {
    line.option("--sol", file_, "FILE.sol with the solution; only the sizes are compared with the program");
  }
  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    const Case& the_case = exchanged_case(chosen);
    if (file_.empty()) throw Error("--sol: no file is named");
    try {
      answer_ = read_ampl_solution(read_file(file_));
      AmplAnswer(*answer_).require_fit(*the_case.transcribe());
    } catch (const Error& error) {
      const std::string reason = error.what();
      if (reason.find(file_) != std::string::npos) throw;
      throw Error("--sol {}: {}", file_, reason);
    }
    return chosen;
  }
  [[nodiscard]] SolvedCase solve(SolveTask task) override {
    task.the_case.solver = "ampl";
    return task.by(AmplAnswer(*answer_, task.options));
  }
  void measure(SolvedCase& solved, IndependentChecks& checks) override {
    if (!answer_->message.empty()) solved.note(fmt::format("The solver reports: {}", answer_->message));
    checks = check_independently(solved);
    solved_ = solved;
  }
  void finish(Table& /*table*/, FurtherOutput& output) override {
    const Status status = solved_->solution.status;
    if (!is_solved(status))
      output.summary.say(fmt::format("read-sol: {}: {}", name_of(status), solved_->solution.message));
    if ((!is_solved(status) && !is_no_motion(status)) || !solved_->accuracy) return;
    write_motion(output.prefix, *solved_, output.metadata);
    output.summary.say(fmt::format("read-sol: {}: {}_nodes.csv", solved_->the_case.label(), output.prefix.string()));
  }

 private:
  std::string file_;
  std::optional<AmplSolution> answer_;
  std::optional<SolvedCase> solved_;
};

int run(int argc, char** argv) { return run_experiment(ReadSol(), argc, argv); }

}  // namespace dmocbench::read_sol_program
