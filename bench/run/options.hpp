#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/run/command_line.hpp"
#include "bench/run/solve_case.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

/// The options that all experiments have.
struct ExperimentOptions {
  std::vector<std::string> problems = paper_problem_names();  ///< "all" alone: every problem there is
  std::vector<std::string> methods = {};                      ///< empty: the families that the paper compares
  std::vector<std::string> integrators = {};                  ///< of shooting; empty: rk4
  std::vector<int> substeps = {};                             ///< of shooting per interval; empty: 1
  std::vector<std::string> tableaus{"gauss"};                 ///< families of Butcher tableaus
  std::string controls = "stage";                       ///< stage, or shared: one control where two intervals meet
  std::vector<int> stages{1};                           ///< numbers of stages s; of galerkin, degrees
  std::vector<std::string> quadratures = {};            ///< of galerkin; empty: the tableaus
  std::vector<int> points = {};                         ///< of its quadratures; empty: s, of Lobatto s + 1
  std::vector<int> control_nodes = {};                  ///< of galerkin; empty: s
  std::vector<std::string> solvers = {};                ///< empty: ipopt for the paper's problems, auto for others
  std::vector<std::string> derivatives{"tape"};         ///< names of back ends
  std::string intervals = {};                           ///< numbers of intervals, as on the command line
  std::filesystem::path grid_file = {};                 ///< relative node times; replaces `intervals`
  std::vector<std::string> settings = {};               ///< "parameter=value"
  std::vector<std::string> passed_on = {};              ///< "option=value" for the solver
  std::string form = "bolza";                           ///< bolza or mayer
  std::vector<std::string> constraints{"multipliers"};  ///< of problems with g(q) = 0: multipliers, embedding
  std::string start = "common";                         ///< common, guess or a file X_nodes.csv
  double tolerance = SolverOptions{}.tolerance;         ///< for the KKT residual of the scaled program
  std::vector<std::string> tolerances = {};  ///< several, where an experiment compares them; empty: `tolerance` alone
  int most_iterations = SolverOptions{}.most_iterations;  ///< of a solver
  double most_seconds = 0.0;                              ///< of a case with its set-up and all grids; 0 for no limit
  double start_seconds = 30.0;                            ///< of the search of a problem's common start
  int jobs = 1;          ///< problems worked on at the same time, where an experiment allows it
  bool batch = false;    ///< cases of one program are solved side by side, where an experiment allows it
  int repeats = 1;       ///< solves per row; times are their medians
  bool verbose = false;  ///< shows the solver's own output
  bool fresh = false;    ///< solves all cases again instead of resuming an interrupted run
  std::filesystem::path out = "results";  ///< folder for results
  std::string name = {};                  ///< of the table and its accompanying files
  std::string part = {};                  ///< "i/n": solve the i-th of n parts of the cases; empty: all
  std::vector<std::string> join = {};     ///< results folders whose parts are joined instead of solving; empty: solve
};

/// The numbers in `tolerances`. Throws `Error` if one is not a number or out of range.
[[nodiscard]] std::vector<double> chosen_tolerances(const ExperimentOptions& options);

/// Whether a problem is one of the two of the paper's section 4.
[[nodiscard]] bool is_of_paper(const std::string& problem);

/// Registers the options with their help.
void add_options(CommandLine& line, ExperimentOptions& options);

/// Registers the options of an experiment whose cases can be dealt out to parts.
void add_part_options(CommandLine& line, ExperimentOptions& options);
/// `--jobs`.
void add_jobs_option(CommandLine& line, ExperimentOptions& options);
/// `--tolerances`.
void add_tolerances_option(CommandLine& line, ExperimentOptions& options);
/// `--batch` and `--no-batch`.
void add_batch_option(CommandLine& line, ExperimentOptions& options);

/// The solver options among them; an interrupt stops the solver. Throws `Error` if one is out of range.
[[nodiscard]] SolverOptions solver_options(const ExperimentOptions& options);
/// The options passed to the solver by name. Throws `Error` if one has no "=" or no name.
[[nodiscard]] NamedOptions named_options(const ExperimentOptions& options);

/// All cases in the order of rows: problem (a mechanism by each chosen form of its constraints), method, tableau,
/// stages, solver, derivatives, intervals ascending. Problems of equal name are the same object. Throws `Error` on
/// anything unknown or out of range, before any file is written.
[[nodiscard]] std::vector<Case> expand_cases(const ExperimentOptions& options);

/// Problems with the settings applied, in the order of the registry; the name "all" stands for every one. A setting
/// must belong to at least one of them. Throws `Error` if one of them cannot be used, or is one of two libraries that
/// have the name; with `faults`, problems that cannot be used are left out and described there instead.
[[nodiscard]] std::vector<std::shared_ptr<const Problem>> selected_problems(const std::vector<std::string>& names,
                                                                            const std::vector<std::string>& settings,
                                                                            std::vector<std::string>* faults = nullptr);

/// The options --problem, --set and --library of an experiment that takes problems by their names.
struct ProblemOptions {
  std::vector<std::string> problems = {};   ///< names; "all" for every one
  std::vector<std::string> settings = {};   ///< "parameter=value"
  std::vector<std::string> libraries = {};  ///< paths

  /// Registers the options; their current values are the defaults.
  void add_to(CommandLine& line);
  /// The problems, after the command line was read: loads the libraries first. Throws `Error` as `selected_problems`
  /// and `load_problem_libraries`.
  [[nodiscard]] std::vector<std::shared_ptr<const Problem>> selected() const;
};

/// Numbers of intervals from a list like "16,48,64" or "8:1024" (8, 16, ..., 1024: doubling while not above the end),
/// or a mixture; ascending, each once, at most 1000. Throws `Error` that names the option and quotes the entry if one
/// is not a whole number between 1 and Grid::most_intervals, or a range ends below its start or holds its start alone.
[[nodiscard]] std::vector<long long> parse_intervals(std::string_view option, std::string_view text);

/// States which numbers the ranges of such a list take whose end is not reached by doubling, as "--intervals 16:100
/// takes 16, 32, 64"; empty if there is no such range.
[[nodiscard]] std::string remark_on_ranges(std::string_view option, std::string_view text);

/// Relative node times, one per line, from a file. Throws `Error` that names the line if one is not a number.
[[nodiscard]] std::vector<double> parse_node_times(std::string_view text);

/// "name=value" apart. Throws `Error` with the option's name if there is no "=" or no name.
[[nodiscard]] std::pair<std::string_view, std::string_view> parse_assignment(std::string_view option,
                                                                             std::string_view text);

/// The whole text as a number. Throws `Error` that begins with `wanted_for`.
[[nodiscard]] double parse_number(std::string_view wanted_for, std::string_view text);

}  // namespace dmocbench
