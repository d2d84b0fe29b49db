#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/experiment/indirect_reference.hpp"
#include "bench/experiment/options.hpp"
#include "bench/experiment/progress.hpp"
#include "bench/experiment/solve_case.hpp"
#include "bench/experiment/start_provider.hpp"

namespace dmocbench {

/// Ways by which `interior_point` solves its linear systems, as its option names them.
[[nodiscard]] const std::vector<std::string>& factorisation_names();

/// The experiment structure_advantage: every method by every solver and way of factorisation. All solves of one problem
/// and grid are repeated in turn, round by round, so that what else the machine does meets all of them alike.
class AdvantageRun {
 public:
  /// Throws `Error` if something chosen does not exist.
  AdvantageRun(const ExperimentOptions& options, const std::vector<std::string>& factorisations,
               const std::vector<std::string>& command_line);

  /// Writes NAME.csv after every grid, NAME_ratios.csv and NAME.json at the end. The exit code: 0, 1 if a solve failed,
  /// 130 if interrupted.
  [[nodiscard]] int run();

  /// One line.
  [[nodiscard]] std::string summary() const;

 private:
  /// A case with what was measured so far.
  struct Subject {
    Case what;
    std::optional<SolvedCase> solved;
    std::vector<double> seconds;
    std::vector<double> evaluation_seconds;
    std::vector<double> linear_seconds;
  };

  [[nodiscard]] std::vector<std::vector<std::size_t>> groups() const;
  [[nodiscard]] static int repeats_of(const Subject& subject);
  void solve_group(const std::vector<std::size_t>& group, Progress& progress);
  void solve_once(Subject& subject, const Progress& progress);
  void complete(Subject& subject);
  void measure_error(const SolvedCase& solved, Row& row);
  [[nodiscard]] Table table() const;

  const ExperimentOptions& options_;
  SolverOptions solver_options_;
  std::vector<Subject> subjects_;
  StartProvider starts_;
  IndirectReference reference_;
  std::filesystem::path prefix_;
  nlohmann::ordered_json metadata_;
  std::size_t failures_ = 0;
};

}  // namespace dmocbench
