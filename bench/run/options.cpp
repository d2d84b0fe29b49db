#include "bench/run/options.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <map>
#include <ranges>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/run/interrupt.hpp"
#include "bench/run/problem_libraries.hpp"
#include "bench/run/result_file.hpp"
#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/embedded_problem.hpp"
#include "methods/mechanics/problem_check.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/derivatives/back_ends.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/elements/galerkin_element.hpp"
#include "methods/transcription/elements/shooting_element.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "problems/problem_registry.hpp"

namespace dmocbench {

namespace {

long long parse_count(std::string_view option, std::string_view text) {
  const auto count = parsed<long long>(text);
  if (!count || *count < 1 || *count > Grid::most_intervals) {
    const std::size_t dash = text.find('-');
    const bool is_range = dash != std::string_view::npos && parsed<long long>(text.substr(0, dash)) &&
                          parsed<long long>(text.substr(dash + 1));
    throw Error("{}: {} is not a whole number between 1 and {}{}", option, as_shown(text), Grid::most_intervals,
                is_range ? fmt::format("; a range is {}:{}", text.substr(0, dash), text.substr(dash + 1)) : "");
  }
  return *count;
}

/// Returns the text before the separator and moves `rest` past it.
std::string_view take_part(std::string_view& rest, char separator) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return part;
}

/// The chosen names in the order of `known`, each once; all if no name is chosen. Throws `Error` on an unknown name.
std::vector<std::string> in_order(const std::string& kind, const std::vector<std::string>& chosen,
                                  const std::vector<std::string>& known) {
  if (chosen.empty()) return known;
  std::set<std::size_t> positions;
  for (const std::string& name : chosen) {
    positions.insert(position_of(known, std::identity(), name, "there is no " + kind));
  }
  std::vector<std::string> names;
  names.reserve(positions.size());
  for (const std::size_t position : positions) names.push_back(known[position]);
  return names;
}

/// The chosen problems in the order of the registry. Throws `Error` on an unknown name.
std::vector<std::string> known_in_order(const std::vector<std::string>& names) {
  try {
    return in_order("problem", names, problem_names());
  } catch (const Error& error) {
    throw Error("{}, or load the library of the problem with --library", error.what());
  }
}

/// The chosen solvers in the order of the registry; where none is chosen, the usual one of a problem.
std::vector<std::string> solvers_for(const Problem& problem, const std::vector<std::string>& chosen) {
  if (!chosen.empty()) return in_order("solver", chosen, solver_names());
  return {is_of_paper(problem.name()) ? "ipopt" : "auto"};
}

std::vector<Grid> make_grids(const ExperimentOptions& options) {
  if (!options.grid_file.empty()) {
    const std::vector<double> times = parse_node_times(read_file(options.grid_file));
    return {Grid::from_nodes(Eigen::Map<const Eigen::VectorXd>(times.data(), std::ssize(times)))};
  }
  std::vector<Grid> grids;
  const std::vector<long long> counts = parse_intervals("--intervals", options.intervals);
  remark(remark_on_ranges("--intervals", options.intervals));
  for (const long long count : counts) grids.push_back(Grid::uniform(count));
  return grids;
}

/// The methods of a family that takes an integrator: every chosen one with every chosen number of substeps.
std::vector<std::string> integrated_methods(std::string_view family, const ExperimentOptions& options) {
  const std::vector<std::string> integrators =
      options.integrators.empty() ? std::vector<std::string>{"rk4"}
                                  : in_order("integrator", options.integrators, explicit_integrator_names());
  std::set<int> substeps(options.substeps.begin(), options.substeps.end());
  if (substeps.empty()) substeps.insert(1);
  std::vector<std::string> names;
  for (const std::string& integrator : integrators) {
    for (const int count : substeps) {
      try {
        require_substeps(count);
      } catch (const Error& error) {
        throw Error("--substeps: {}", error.what());
      }
      names.push_back(shooting_name(family, integrator, count));
    }
  }
  return names;
}

/// The families of tableaus with controls as chosen.
std::vector<std::string> chosen_tableaus(const ExperimentOptions& options) {
  if (options.controls == "stage") return options.tableaus;
  if (options.controls != "shared") {
    throw Error("--controls takes stage or shared, not {}", options.controls);
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

/// A method by a tableau.
struct ChosenScheme {
  std::string method;
  std::string tableau;
  int stages = 0;
};

/// A family of tableaus and a number of stages.
using FamilyAndStages = std::pair<std::string, int>;

/// The chosen families of tableaus, each with the chosen numbers of stages that it supports, ascending. Throws `Error`
/// if no family supports one of the numbers.
std::vector<FamilyAndStages> chosen_stages(const ExperimentOptions& options) {
  const auto families = in_order("tableau", chosen_tableaus(options), tableau_names());
  std::vector<FamilyAndStages> schemes;
  for (const std::string& family : families) {
    for (const int stages : tableau_stages(family)) {
      if (std::ranges::count(options.stages, stages) > 0) schemes.emplace_back(family, stages);
    }
  }
  for (const int stages : options.stages) {
    if (std::ranges::count(schemes, stages, &FamilyAndStages::second) > 0) {
      for (const std::string& family : families) {
        if (std::ranges::count(schemes, FamilyAndStages(family, stages)) == 0)
          remark(fmt::format("--stages {} is left out for {}, which supports {}", stages, family,
                             fmt::join(tableau_stages(family), ", ")));
      }
      continue;
    }
    throw Error("--stages: {} supports {} stages, not {}", families.front(),
                fmt::join(tableau_stages(families.front()), ", "), stages);
  }
  return schemes;
}

/// Every number of `chosen`, ascending; the usual one if there is none.
std::set<int> chosen_numbers(const std::vector<int>& chosen, int usual) {
  return chosen.empty() ? std::set{usual} : std::set(chosen.begin(), chosen.end());
}

/// Galerkin methods of all chosen degrees, quadratures and control nodes. Of several numbers those combinations are
/// taken that exist; throws `Error` if a number is in none.
std::vector<ChosenScheme> galerkin_schemes(const ExperimentOptions& options) {
  using Number = std::pair<std::string, int>;  // an option's
  if (options.controls != "stage" && options.controls != "shared") static_cast<void>(chosen_tableaus(options));
  const bool is_continuous = options.controls == "shared";
  const auto quadratures = in_order("quadrature", options.quadratures.empty() ? options.tableaus : options.quadratures,
                                    {"gauss", "lobatto"});
  std::vector<ChosenScheme> schemes;
  std::set<Number> used;
  std::map<Number, std::string> refused;
  const auto add = [&](int degree, int nodes, const std::string& quadrature, int points) {
    const std::array<Number, 3> numbers{{{"--stages", degree}, {"--control-nodes", nodes}, {"--points", points}}};
    try {
      const GalerkinElement element(degree, nodes, is_continuous);
      const Tableau tableau = make_tableau(quadrature, points);
      static_cast<void>(element.rates(tableau));
      static_cast<void>(element.controls(tableau));
      schemes.push_back({element.name(), quadrature, points});
      used.insert(numbers.begin(), numbers.end());
    } catch (const Error& error) {
      for (const Number& number : numbers) refused.emplace(number, error.what());
    }
  };
  for (const int degree : std::set(options.stages.begin(), options.stages.end())) {
    for (const int nodes : chosen_numbers(options.control_nodes, std::max(degree, is_continuous ? 2 : 1))) {
      for (const std::string& quadrature : quadratures) {
        const int fewest = degree + (quadrature == "lobatto" ? 1 : 0);
        for (const int points : chosen_numbers(options.points, fewest)) add(degree, nodes, quadrature, points);
      }
    }
  }
  for (const auto& [number, reason] : refused) {
    if (!used.contains(number)) throw Error(reason);
  }
  return schemes;
}

/// The chosen families by the chosen tableaus.
std::vector<ChosenScheme> chosen_schemes(const ExperimentOptions& options) {
  const std::vector<std::string> chosen =
      in_order("method", options.methods.empty() ? paper_families() : options.methods, all_families());
  std::vector<ChosenScheme> schemes;
  const auto add_with_tableaus = [&](const std::vector<std::string>& methods) {
    const auto tableaus = chosen_stages(options);
    for (const std::string& method : methods) {
      for (const auto& [tableau, stages] : tableaus) schemes.push_back({method, tableau, stages});
    }
  };
  bool integrates = false;
  bool has_spaces = false;
  for (const Family& family : registered_families()) {
    if (std::ranges::count(chosen, family.name) == 0) continue;
    switch (family.suffix) {
      case MethodSuffix::none:
        add_with_tableaus({std::string(family.name)});
        break;
      case MethodSuffix::integration:
        add_with_tableaus(integrated_methods(family.name, options));
        integrates = true;
        break;
      case MethodSuffix::spaces:
        std::ranges::move(galerkin_schemes(options), std::back_inserter(schemes));
        has_spaces = true;
        break;
    }
  }
  if (!integrates && !(options.integrators.empty() && options.substeps.empty())) {
    throw Error("--integrator and --substeps apply only to shooting; add --method multiple_shooting");
  }
  if (!has_spaces && !(options.quadratures.empty() && options.points.empty() && options.control_nodes.empty())) {
    throw Error("--quadrature, --points and --control-nodes apply only to galerkin; add --method galerkin");
  }
  return schemes;
}

/// A problem by each chosen form of its constraints; as it is if it has none.
std::vector<std::shared_ptr<const Problem>> in_chosen_forms(const std::shared_ptr<const Problem>& problem,
                                                            const ExperimentOptions& options) {
  const std::vector<std::string> forms =
      in_order("form of constraints", options.constraints, {"multipliers", "embedding"});
  const bool has_constraints = TracedProblem(*problem).holonomic_count() > 0;
  if (!has_constraints && forms.front() == "multipliers") return {problem};
  std::vector<std::shared_ptr<const Problem>> result;
  for (const std::string& form : forms) {
    result.push_back(form == "multipliers" ? problem : std::make_shared<const EmbeddedProblem>(problem));
  }
  return result;
}

}  // namespace

bool is_of_paper(const std::string& problem) {
  const std::vector<std::string> names = paper_problem_names();
  return std::ranges::find(names, problem) != names.end();
}

void add_options(CommandLine& line, ExperimentOptions& options) {
  line.group(group_of_problem);
  line.list("--problem", options.problems, "names of problems (see `dmocbench list`), or all");
  line.option("--set", options.settings,
              "parameter=value of a problem (see `dmocbench list --problem NAME`); may be repeated");
  line.option("--form", options.form,
              "form of the cost: bolza (a sum), or mayer (the cost up to each node is an additional unknown)");
  line.list(
      "--constraints", options.constraints,
      "treatment of holonomic constraints g(q) = 0: multipliers, or embedding (the coordinates of Problem::embedding "
      "at the nodes; only dmoc and hamiltonian with one Gauss stage; tables name the problem NAME_embedded)");
  line.group("Method");
  line.list("--method", options.methods,
            fmt::format("methods: {}", fmt::join(all_families(), ", ")) +
                (options.methods.empty() ? fmt::format("; default: {}", fmt::join(paper_families(), ", ")) : ""));
  line.list("--tableau", options.tableaus, "families of Butcher tableaus");
  line.list("--stages", options.stages, "numbers of stages s; each tableau uses the numbers that it supports");
  line.option("--controls", options.controls,
              "stage: every stage has its own control; shared: neighbouring intervals share the control at their "
              "common node (only with --tableau lobatto; lobatto_shared in tables)");
  line.list("--quadrature", options.quadratures,
            "quadrature of galerkin: gauss or lobatto; the number of stages s is the degree of q; default: the "
            "tableaus of --tableau");
  line.list("--points", options.points, "number of quadrature points, at least s; default: s (lobatto: s + 1)");
  line.list("--control-nodes", options.control_nodes,
            "number of control points of galerkin per interval: Gauss points (1 for a constant control), or Lobatto "
            "points with --controls shared (for a continuous control); default: s");
  line.list("--integrator", options.integrators, "integrators of shooting: rk4, midpoint; default: rk4");
  line.list("--substeps", options.substeps, "integrator steps of shooting per interval; default: 1");
  line.group("Grid");
  line.option("--intervals", options.intervals,
              "numbers of intervals N: a list 16,48,64, a doubling range 8:1024, or both mixed");
  line.option("--grid", options.grid_file,
              "file with relative node times from 0 to 1, one per line; replaces --intervals");
  line.ignored_unless(
      "--intervals", [&options] { return options.grid_file.empty(); }, "--grid replaces it");
  line.group("Start");
  line.option("--start", options.start,
              "start of the solves: common (one trajectory for all methods and grids), guess (the problem's guess), or "
              "a CSV file with columns t, q and v_q per configuration, and optionally controls and costates");
  line.number("--start-seconds", options.start_seconds, 0.0, 1e6,
              "time limit for finding the common start of a problem (and tableau); if it is reached, solves start at "
              "the guess");
  line.group("Solver");
  line.list("--solver", options.solvers,
            std::string("names of solvers; see `dmocbench list`") +
                (options.solvers.empty() ? "; default: ipopt for the paper's two problems, auto for others" : ""));
  line.list("--derivatives", options.derivatives, "derivative back ends; see `dmocbench list`");
  line.option("--tolerance", options.tolerance, "tolerance for the KKT residual of the scaled program");
  line.option("--iterations", options.most_iterations, "maximum number of solver iterations");
  line.number("--seconds", options.most_seconds, 0.0, 1e6,
              "time limit per case, including set-up and all grids; 0: no limit");
  line.option("--option", options.passed_on, "option=value passed to the solver; may be repeated");
  line.option("--repeats", options.repeats, "number of solves per row; times are medians");
  line.flag("--verbose", options.verbose, "show the solver's own output", OptionRole::machine);
  line.group(group_of_output);
  line.option("--out", options.out, "folder for the results", OptionRole::place);
  line.option("--name", options.name, "name of the table and of the files next to it", OptionRole::place);
  line.flag("--fresh", options.fresh, "solve all cases instead of resuming an interrupted run", OptionRole::machine);
}

void add_jobs_option(CommandLine& line, ExperimentOptions& options) {
  line.number("--jobs", options.jobs, 1, 256,
              "number of processes; each solves one problem at a time, or, in large batches, one method of a problem",
              OptionRole::machine);
}

void add_tolerances_option(CommandLine& line, ExperimentOptions& options) {
  line.list("--tolerances", options.tolerances, "several tolerances, one row for each; overrides --tolerance");
  line.ignored_unless(
      "--tolerance", [&options] { return options.tolerances.empty(); }, "--tolerances replaces it");
}

void add_batch_option(CommandLine& line, ExperimentOptions& options) {
  line.flag(
      "--batch,!--no-batch", options.batch,
      "solve cases that differ only in start, parameters or end states with interior_point, eight at a time; times "
      "are not measured; cannot be combined with --seconds, --option, --verbose or --repeats");
  line.ignored_unless(
      "--batch",
      [&options] {
        const bool is_plain = options.most_seconds <= 0.0 && options.passed_on.empty() && !options.verbose &&
                              options.repeats == 1 && options.derivatives == ExperimentOptions().derivatives;
        const auto is_ours = [](const std::string& name) { return name == "interior_point" || name == "auto"; };
        return !options.batch || (is_plain && std::ranges::any_of(options.solvers, is_ours));
      },
      "batches support interior_point and auto, without --seconds, --option, --verbose, --repeats and --derivatives");
}

void add_part_options(CommandLine& line, ExperimentOptions& options) {
  line.group("Parts");
  line.option("--part", options.part,
              "i/n: solve only the i-th of n parts of the cases and keep its rows in OUT/NAME.parts/i-of-n.rows. An "
              "interrupted part is resumed. The exit code is 0 even if solves fail",
              OptionRole::place);
  line.option("--join", options.join,
              "results folder with parts of the same command, which are joined into one table instead of solving; may "
              "be repeated",
              OptionRole::place);
}

SolverOptions solver_options(const ExperimentOptions& options) {
  SolverOptions result;
  result.tolerance = options.tolerance;
  result.most_iterations = options.most_iterations;
  result.most_seconds = options.most_seconds;
  result.verbose = options.verbose;
  result.stop_requested = interrupt_requested;
  result.validate();
  return result;
}

NamedOptions named_options(const ExperimentOptions& options) {
  NamedOptions result;
  for (const std::string& text : options.passed_on) {
    const auto [name, value] = parse_assignment("--option", text);
    result.emplace(name, value);
  }
  return result;
}

std::vector<double> chosen_tolerances(const ExperimentOptions& options) {
  std::vector<double> tolerances;
  for (const std::string& text : options.tolerances) {
    SolverOptions solver;
    solver.tolerance = parse_number("--tolerances", text);
    solver.validate();
    tolerances.push_back(solver.tolerance);
  }
  return tolerances;
}

std::vector<std::shared_ptr<const Problem>> selected_problems(const std::vector<std::string>& names,
                                                              const std::vector<std::string>& settings,
                                                              std::vector<std::string>* faults) {
  std::vector<std::shared_ptr<Problem>> problems;
  const bool all = names == std::vector<std::string>{"all"};
  for (const Registry::Refusal& refusal : known_problems().refused()) {
    const bool is_chosen = all ? faults == nullptr : std::ranges::count(names, refusal.name) > 0;
    if (is_chosen) throw Error(refusal.reason);
    if (all) faults->push_back(refusal.reason);
  }
  const std::vector<std::string> chosen = all ? problem_names() : known_in_order(names);
  problems.reserve(chosen.size());
  for (const std::string& name : chosen) problems.push_back(make_unchecked_problem(name));
  for (const std::string& setting : settings) {
    const auto [name, text] = parse_assignment("--set", setting);
    const double value = parse_number(fmt::format("--set {}", name), text);
    const auto has_parameter = [name = name](const std::shared_ptr<Problem>& problem) {
      return std::ranges::count(problem->parameters(), name, &Parameter::name) > 0;
    };
    if (std::ranges::none_of(problems, has_parameter)) problems.back()->set_parameter(name, value);  // throws
    for (const auto& problem : problems | std::views::filter(has_parameter)) problem->set_parameter(name, value);
  }
  // Not before: defaults may need a setting, and settings move bounds and ends.
  const auto can_be_used = [faults](const std::shared_ptr<Problem>& problem) {
    try {
      check_problem(*problem);
      return true;
    } catch (const Error& error) {
      if (faults == nullptr) throw;
      faults->push_back(fmt::format("the problem of class {} cannot be used: {}",
                                    known_problems().class_of(problem->name()), error.what()));
      return false;
    }
  };
  std::erase_if(problems, std::not_fn(can_be_used));
  return {problems.begin(), problems.end()};
}

void ProblemOptions::add_to(CommandLine& line) {
  line.group(group_of_problem);
  line.list("--problem", problems, "names of problems (see `dmocbench list`), or all");
  line.option("--set", settings, "parameter=value of a problem (see `dmocbench list --problem NAME`); may be repeated");
  add_library_option(line, libraries);
  line.group("Options");
}

std::vector<std::shared_ptr<const Problem>> ProblemOptions::selected() const {
  load_problem_libraries(libraries);
  return selected_problems(problems, settings);
}

std::vector<Case> expand_cases(const ExperimentOptions& options) {
  const std::vector<ChosenScheme> schemes = chosen_schemes(options);
  if (!options.solvers.empty()) static_cast<void>(in_order("solver", options.solvers, solver_names()));
  for (const std::string& name : options.derivatives) static_cast<void>(derivative_back_end_description(name));
  const auto back_ends = in_order("derivative back end", options.derivatives, derivative_back_end_names());
  require_name_of_table(options.name);
  if (options.repeats < 1) throw Error("--repeats must be at least 1, got {}", options.repeats);
  const std::vector<Grid> grids = make_grids(options);
  const CostForm form = cost_form_named(options.form);
  std::vector<Case> cases;
  std::set<std::string> left_out;
  const bool all = options.problems == std::vector<std::string>{"all"};
  std::vector<std::shared_ptr<const Problem>> problems;
  for (const auto& problem : selected_problems(options.problems, options.settings)) {
    std::ranges::move(in_chosen_forms(problem, options), std::back_inserter(problems));
  }
  for (const auto& problem : problems) {
    const std::vector<std::string> solvers = solvers_for(*problem, options.solvers);
    // Of all problems those with constraints of the motion are left out where a method lacks them; alone they are
    // refused.
    const TracedProblem traced(*problem);
    const auto is_offered = [&](const ChosenScheme& scheme) {
      return !all ||
             takes_constraints(*make_element(scheme.method), traced, make_tableau(scheme.tableau, scheme.stages));
    };
    // All methods have the same degrees of freedom on a grid, and more stages have more: one program per family shows
    // whether the problem is well posed and the coarsest grid fine enough.
    std::set<std::string> checked;
    for (const ChosenScheme& scheme : schemes) {
      const auto& [method, tableau, stages] = scheme;
      if (!is_offered(scheme) || !checked.insert(tableau).second) continue;
      const Case coarsest{problem, method, tableau, stages, "", "tape", grids.front(), {}, form};
      try {
        const StopScope scope(interrupt_requested, options.most_seconds);
        static_cast<void>(coarsest.transcribe());
      } catch (const Stopped&) {
        throw Error("{} takes longer than --seconds {:g} to set up; allow more time, or use fewer intervals",
                    problem->name(), options.most_seconds);
      }
    }
    for (const ChosenScheme& scheme : schemes) {
      if (!is_offered(scheme)) {
        left_out.insert(fmt::format("{} by {}", problem->name(), scheme.method));
        continue;
      }
      const auto& [method, tableau, stages] = scheme;
      for (const std::string& solver : solvers) {
        for (const std::string& derivatives : back_ends) {
          for (const Grid& grid : grids) {
            cases.push_back({problem, method, tableau, stages, solver, derivatives, grid, {}, form});
          }
        }
      }
    }
  }
  if (!left_out.empty())
    remark(fmt::format("--problem all leaves out problems with constraints on q or v: {}", fmt::join(left_out, ", ")));
  return cases;
}

std::vector<long long> parse_intervals(std::string_view option, std::string_view text) {
  constexpr std::size_t most_counts = 1000;
  std::set<long long> counts;
  if (text.ends_with(',')) throw Error("{}: there is an empty entry at the end of {}", option, as_shown(text));
  std::string_view rest = text;
  do {
    std::string_view entry = take_part(rest, ',');
    const std::string whole(entry);
    const bool is_range = entry.find(':') != std::string_view::npos;
    const long long first = parse_count(option, take_part(entry, ':'));
    const long long last = is_range ? parse_count(option, entry) : first;
    if (last < first) throw Error("{}: the range {} ends below its start", option, whole);
    if (last > first && last < 2 * first)
      throw Error("{}: the range {} contains only {}; write {},{}", option, whole, first, first, last);
    for (long long count = first; count <= last; count *= 2) counts.insert(count);
    if (counts.size() > most_counts) {  // all grids are in memory at the same time
      throw Error("{} takes at most {} numbers; run the rest with another --name", option, most_counts);
    }
  } while (!rest.empty());
  return {counts.begin(), counts.end()};
}

std::string remark_on_ranges(std::string_view option, std::string_view text) {
  std::vector<std::string> remarks;
  while (!text.empty()) {
    const std::string_view entry = take_part(text, ',');
    const std::size_t colon = entry.find(':');
    if (colon == std::string_view::npos) continue;
    const std::vector<long long> counts = parse_intervals(option, entry);
    if (counts.back() == parse_count(option, entry.substr(colon + 1))) continue;
    remarks.push_back(fmt::format("{} {} takes {}", option, entry, fmt::join(counts, ", ")));
  }
  return remarks.empty() ? "" : fmt::format("{}: a range doubles its start repeatedly", fmt::join(remarks, "; "));
}

std::vector<double> parse_node_times(std::string_view text) {
  std::vector<double> times;
  for (int line = 1; !text.empty(); ++line) {
    std::string_view entry = take_part(text, '\n');
    while (!entry.empty() && (entry.back() == '\r' || entry.back() == ' ')) entry.remove_suffix(1);
    if (entry.empty()) continue;
    if (std::cmp_greater(times.size(), Grid::most_intervals)) {
      throw Error("--grid, line {}: a grid has at most {} intervals", line, Grid::most_intervals);
    }
    times.push_back(parse_number(fmt::format("--grid, line {}", line), entry));
  }
  return times;
}

std::pair<std::string_view, std::string_view> parse_assignment(std::string_view option, std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw Error("{} takes name=value, got \"{}\"", option, text);
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

double parse_number(std::string_view wanted_for, std::string_view text) {
  const auto value = parsed<double>(text);
  if (!value) throw Error("{}: {} is not a number", wanted_for, as_shown(text));
  return *value;
}

}  // namespace dmocbench
