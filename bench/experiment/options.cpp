#include "bench/experiment/options.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/experiment/interval_list.hpp"
#include "bench/experiment/result_file.hpp"
#include "methods/error.hpp"
#include "methods/transcription/derivative_back_end.hpp"
#include "methods/transcription/element.hpp"
#include "methods/transcription/tableau.hpp"

namespace dmocbench {

namespace {

/// The chosen names in the order of `known`, each once; all if none is chosen. Throws `Error` on one that is not known.
std::vector<std::string> in_order(const char* kind, const std::vector<std::string>& chosen,
                                  const std::vector<std::string>& known) {
  for (const std::string& name : chosen) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw Error(fmt::format("there is no {} \"{}\"; choose one of {}", kind, name, fmt::join(known, ", ")));
    }
  }
  std::vector<std::string> result;
  for (const std::string& name : known) {
    if (chosen.empty() || std::find(chosen.begin(), chosen.end(), name) != chosen.end()) result.push_back(name);
  }
  return result;
}

std::vector<Grid> make_grids(const ExperimentOptions& options) {
  std::vector<Grid> grids;
  if (!options.grid_file.empty()) {
    const std::vector<double> times = parse_node_times(read_file(options.grid_file));
    grids.push_back(
        Grid::from_nodes(Eigen::Map<const Eigen::VectorXd>(times.data(), static_cast<Eigen::Index>(times.size()))));
    return grids;
  }
  for (const long long count : parse_intervals("--intervals", options.intervals)) grids.push_back(Grid::uniform(count));
  return grids;
}

/// The families of tableaus with controls as chosen.
std::vector<std::string> chosen_tableaus(const ExperimentOptions& options) {
  if (options.controls == "stage") return options.tableaus;
  if (options.controls != "shared") {
    throw Error(fmt::format("--controls takes stage or shared, not {}", options.controls));
  }
  std::vector<std::string> tableaus;
  for (const std::string& family : options.tableaus) {
    if (family == "gauss") {
      throw Error("--controls shared: gauss has no stage where two intervals meet; choose --tableau lobatto");
    }
    tableaus.push_back(family == "lobatto" ? "lobatto_shared" : family);
  }
  return tableaus;
}

bool is_offered(const std::string& tableau, int stages) {
  const std::vector<int> known = tableau_stages(tableau);
  return std::find(known.begin(), known.end(), stages) != known.end();
}

/// Throws `Error` if none of the tableaus is offered with one of the numbers of stages.
void require_offered(const std::vector<std::string>& tableaus, const std::vector<int>& stages) {
  for (const int s : stages) {
    if (std::any_of(tableaus.begin(), tableaus.end(), [&](const auto& tableau) { return is_offered(tableau, s); })) {
      continue;
    }
    const std::string& tableau = tableaus.front();
    throw Error(fmt::format("--stages: {} is offered with {} stages, not with {}", tableau,
                            fmt::join(tableau_stages(tableau), ", "), s));
  }
}

/// The chosen numbers of stages that a tableau is offered with, ascending, each once.
std::vector<int> sorted_stages(std::vector<int> stages, const std::string& tableau) {
  std::sort(stages.begin(), stages.end());
  stages.erase(std::unique(stages.begin(), stages.end()), stages.end());
  std::erase_if(stages, [&](int s) { return !is_offered(tableau, s); });
  return stages;
}

/// Throws `Error` if a problem is not well posed or the coarsest grid too coarse. All methods have as many degrees of
/// freedom on a grid, and more stages have more, so that one transcription per tableau tells.
void require_enough_intervals(const std::shared_ptr<const Problem>& problem, const std::string& method,
                              const std::string& tableau, int stages, const Grid& coarsest, CostForm form) {
  static_cast<void>(
      Case{.problem = problem, .method = method, .tableau = tableau, .stages = stages, .grid = coarsest, .form = form}
          .transcribe());
}

}  // namespace

void add_options(CommandLine& line, ExperimentOptions& options) {
  line.option("--problem", options.problems, "problems, as `list` names them; all: every one")
      .comma_separated()
      .shows_default();
  line.option("--method", options.methods, "methods: dmoc, hamiltonian, tangent; default: all").comma_separated();
  line.option("--tableau", options.tableaus, "families of Butcher tableaus").comma_separated().shows_default();
  line.option("--controls", options.controls,
              "stage: every stage has its control; shared: one where two intervals meet, for --tableau lobatto, which "
              "the tables then call lobatto_shared")
      .shows_default();
  line.option("--stages", options.stages, "numbers of stages s; a tableau takes those that it is offered with")
      .comma_separated()
      .shows_default();
  line.option("--solver", options.solvers, "solvers, as `list` names them").comma_separated().shows_default();
  line.option("--derivatives", options.derivatives, "back ends of derivatives, as `list` names them")
      .comma_separated()
      .shows_default();
  line.option("--intervals", options.intervals,
              "numbers of intervals N: a list 16,48,64, a doubling range 8:1024, or both mixed")
      .shows_default();
  line.option("--grid", options.grid_file,
              "file with relative node times from 0 to 1, one per line; replaces --intervals");
  line.option("--set", options.settings, "parameter=value of a problem, as `list` shows them; may be repeated");
  line.option("--form", options.form,
              "how the cost is stated: bolza (a sum), or mayer (one more unknown per node, the cost so far)")
      .shows_default();
  line.option("--start", options.start,
              "where solves start: common (one motion for all methods and grids), guess (the problem's own), or a file "
              "X_nodes.csv written by solve")
      .shows_default();
  line.option("--tolerance", options.tolerance, "for the KKT residual of the scaled program").shows_default();
  line.option("--iterations", options.most_iterations, "largest number of iterations of a solver").shows_default();
  line.option("--option", options.passed_on, "option=value passed on to the solver; may be repeated");
  line.option("--repeats", options.repeats, "solves per row; times are medians").shows_default();
  line.option("--out", options.out, "folder for the results").shows_default();
  line.option("--name", options.name, "name of the table and the files beside it").shows_default();
  line.flag("--verbose", options.verbose, "show the solver's own output");
}

SolverOptions solver_options(const ExperimentOptions& options) {
  SolverOptions result;
  result.tolerance = options.tolerance;
  result.most_iterations = options.most_iterations;
  result.verbose = options.verbose;
  for (const std::string& text : options.passed_on) {
    const auto [name, value] = parse_assignment("--option", text);
    result.passed_on.emplace(name, value);
  }
  result.validate();
  return result;
}

std::vector<std::shared_ptr<const Problem>> selected_problems(const std::vector<std::string>& names,
                                                              const std::vector<std::string>& settings) {
  std::vector<std::shared_ptr<Problem>> problems;
  const bool all = names == std::vector<std::string>{"all"};
  const std::vector<std::string> chosen = all ? problem_names() : in_order("problem", names, problem_names());
  for (const std::string& name : chosen) problems.push_back(make_problem(name));
  for (const std::string& setting : settings) {
    const auto [name, text] = parse_assignment("--set", setting);
    const double value = parse_number(fmt::format("--set {}", name), text);
    bool known = false;
    for (const auto& problem : problems) {
      const auto& parameters = problem->parameters();
      const bool has = std::any_of(parameters.begin(), parameters.end(),
                                   [wanted = name](const Parameter& parameter) { return parameter.name == wanted; });
      if (has) problem->set_parameter(name, value);
      known = known || has;
    }
    if (!known) problems.back()->set_parameter(name, value);  // throws with the names there are
  }
  return {problems.begin(), problems.end()};
}

std::vector<Case> expand_cases(const ExperimentOptions& options) {
  const auto methods = in_order("method", options.methods, element_names());
  const auto tableaus = in_order("tableau", chosen_tableaus(options), tableau_names());
  require_offered(tableaus, options.stages);
  const auto solvers = in_order("solver", options.solvers, solver_names());
  for (const std::string& name : options.derivatives) static_cast<void>(derivative_back_end_description(name));
  const auto back_ends = in_order("back end of derivatives", options.derivatives, derivative_back_end_names());
  if (options.name.empty() || options.name.find('/') != std::string::npos) {
    throw Error(
        fmt::format("--name \"{}\" must be a file's name without a folder; --out names the folder", options.name));
  }
  if (options.repeats < 1) throw Error(fmt::format("--repeats must be at least 1, got {}", options.repeats));
  const std::vector<Grid> grids = make_grids(options);
  const CostForm form = cost_form_named(options.form);
  std::vector<Case> cases;
  for (const auto& problem : selected_problems(options.problems, options.settings)) {
    for (const std::string& tableau : tableaus) {
      const std::vector<int> stages = sorted_stages(options.stages, tableau);
      if (!stages.empty())
        require_enough_intervals(problem, methods.front(), tableau, stages.front(), grids.front(), form);
    }
    for (const std::string& method : methods) {
      for (const std::string& tableau : tableaus) {
        for (const int stages : sorted_stages(options.stages, tableau)) {
          for (const std::string& solver : solvers) {
            for (const std::string& derivatives : back_ends) {
              for (const Grid& grid : grids) {
                cases.push_back({problem, method, tableau, stages, solver, derivatives, grid, "", form});
              }
            }
          }
        }
      }
    }
  }
  return cases;
}

}  // namespace dmocbench
