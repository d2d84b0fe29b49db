// Lists problems with their data and their known optimum, methods, tableaus, solvers, derivative back ends.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/claims/claims_table.hpp"
#include "bench/programs.hpp"
#include "bench/run/described_tables.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/metadata.hpp"
#include "bench/run/problem_card_json.hpp"
#include "bench/run/problem_libraries.hpp"
#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/transcription/derivatives/back_ends.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/elements/shooting_element.hpp"
#include "problems/problem_registry.hpp"
#include "problems/registry.hpp"

namespace dmocbench::list_program {

std::string listed(const Eigen::VectorXd& vector) { return fmt::format("({:.6g})", fmt::join(vector, ", ")); }

/// Prints a line with its label, unless the content is empty.
void print_field(const std::string& label, const std::string& content) {
  if (!content.empty()) fmt::print("    {:<9} {}\n", label, content);
}

/// "-2 <= x <= 2" or "u_1 >= 0"; empty if the entry is not bounded.
std::string bound_in_words(const Bounds& bounds, Eigen::Index i, const std::string& name) {
  const bool has_upper = std::isfinite(bounds.upper[i]);
  if (!std::isfinite(bounds.lower[i])) return has_upper ? fmt::format("{} <= {:.6g}", name, bounds.upper[i]) : "";
  if (!has_upper) return fmt::format("{} >= {:.6g}", name, bounds.lower[i]);
  return fmt::format("{:.6g} <= {} <= {:.6g}", bounds.lower[i], name, bounds.upper[i]);
}

/// The bounded entries, or "none".
std::string bounds_in_words(const Bounds& bounds, const std::vector<std::string>& names) {
  std::vector<std::string> parts;
  for (Eigen::Index i = 0; i < bounds.lower.size(); ++i) {
    parts.push_back(bound_in_words(bounds, i, names[static_cast<std::size_t>(i)]));
  }
  std::erase(parts, "");
  return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

/// "x [m]" where units are stated.
std::vector<std::string> with_units(std::vector<std::string> names, const std::vector<std::string>& units) {
  for (std::size_t i = 0; i < std::min(names.size(), units.size()); ++i) {
    if (!units[i].empty()) names[i] += " [" + units[i] + "]";
  }
  return names;
}

std::vector<std::string> velocity_names(const Problem& problem) {
  std::vector<std::string> names = problem.configuration_names();
  for (std::string& name : names) name.insert(0, "v_");
  return names;
}

/// The state at an end, and which of its components are not prescribed.
std::string end_in_words(const Problem& problem, const BoundaryState& state, const EndBounds& bounds) {
  std::vector<std::string> free;
  std::vector<std::string> between;
  const auto sort = [&](const Bounds& of, const std::vector<std::string>& names) {
    for (Eigen::Index i = 0; i < of.lower.size(); ++i) {
      const std::string& name = names[static_cast<std::size_t>(i)];
      if (!of.is_bounded(i)) free.push_back(name);
      if (of.is_bounded(i) && !of.is_fixed(i)) between.push_back(bound_in_words(of, i, name));
    }
  };
  sort(bounds.q, problem.configuration_names());
  sort(bounds.v, velocity_names(problem));
  return fmt::format("q = {}, v = {}{}{}{}{}", listed(state.q), listed(state.v),
                     free.empty() ? "" : "; free (values are the guess): ", fmt::join(free, ", "),
                     between.empty() ? "" : "; ", fmt::join(between, ", "));
}

std::string horizon_in_words(const Problem& problem) {
  const Unit time = problem.card().time_unit;
  const HorizonBounds bounds = problem.bounds().horizon;
  const double guessed = problem.horizon();
  const std::string in_unit = time.name.empty() ? "" : fmt::format(" ({:.6g} {})", guessed * time.factor, time.name);
  if (!bounds.is_free()) return fmt::format("T = {:.6g}{}", guessed, in_unit);
  return fmt::format("{:.6g} <= T <= {:.6g}, guessed {:.6g}{}", bounds.lower, bounds.upper, guessed, in_unit);
}

void print_reference(const Problem& problem) {
  const auto reference = problem.card().reference;
  if (!reference) {
    print_field("optimum", "unknown for these parameter values");
    return;
  }
  print_field("optimum", fmt::format("{:#.{}g}, {} digits: {}", reference->objective, reference->digits,
                                     reference->digits, reference->certificate));
  for (const PublishedOptimum& published : reference->published) {
    print_field("published", fmt::format("{:.12g}, {}", published.objective, published.source));
  }
  print_field("remark", reference->remark);
}

/// The card's words, unless they are the default's and the problem has a guess of its own.
std::string guess_in_words(const Problem& problem) {
  std::string words = problem.card().guess;
  if (words != ProblemCard().guess) return words;
  for (const double share : {0.0, 0.3, 0.6, 1.0}) {
    const double t = share * problem.horizon();
    const MotionPoint own = problem.guess(t);
    const MotionPoint usual = problem.Problem::guess(t);
    const auto differ = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
      return a.size() != b.size() || a != b;
    };
    if (differ(own.q, usual.q) || differ(own.v, usual.v) || differ(own.u, usual.u)) {
      return "defined in code; the problem's card does not describe it (ProblemCard::guess)";
    }
  }
  return words;
}

void print_problem(const Problem& problem) {
  const TracedProblem traced(problem);
  const auto q_names = problem.configuration_names();
  fmt::print("{}\n", problem.name());
  if (!problem.card().description.empty()) fmt::print("    {}\n", problem.card().description);
  const std::string& library = known_problems().origin(problem.name());
  print_field("library", library.empty() ? "dmocbench" : library);
  print_field("source", problem.card().source);
  const ProblemCard card = problem.card();
  print_field("q", fmt::format("({})   u  ({})", fmt::join(with_units(q_names, card.configuration_units), ", "),
                               fmt::join(with_units(problem.control_names(), card.control_units), ", ")));
  if (problem.first_order_size() > 0)
    print_field("y", fmt::format("({}), first-order states", fmt::join(problem.first_order_names(), ", ")));
  print_field("start", end_in_words(problem, problem.initial_state(), problem.bounds().first));
  for (const InteriorBounds& at : problem.bounds().interior) {
    print_field("between", fmt::format("at t/T = {:.6g}, q: {}; v: {}; y: {}", at.relative_time,
                                       bounds_in_words(at.q, q_names), bounds_in_words(at.v, velocity_names(problem)),
                                       bounds_in_words(at.y, problem.first_order_names())));
  }
  print_field("end", end_in_words(problem, problem.final_state(), problem.bounds().last));
  print_field("horizon", horizon_in_words(problem));
  print_field("bounds", fmt::format("on q: {}; on v: {}; on u: {}", bounds_in_words(problem.bounds().q, q_names),
                                    bounds_in_words(problem.bounds().v, velocity_names(problem)),
                                    bounds_in_words(problem.bounds().u, problem.control_names())));
  print_field(
      "rows",
      fmt::format("{}, {}{}{}{}", counted(traced.path_constraint_count(), "path constraint"),
                  counted(traced.boundary_condition_count(), "boundary condition"),
                  traced.holonomic_count() > 0
                      ? ", " + counted(traced.holonomic_count(), "constraint g(q) = 0", "constraints g(q) = 0")
                      : "",
                  traced.velocity_constraint_count() > 0
                      ? ", " + counted(traced.velocity_constraint_count(), "velocity constraint")
                      : "",
                  traced.integral_count() > 0 ? ", " + counted(traced.integral_count(), "integral constraint") : ""));
  print_reference(problem);
  print_field("guess", guess_in_words(problem));
  print_field("scale", fmt::format("the cost is multiplied by {:g} for the solver", problem.cost_scale()));
  for (const Parameter& parameter : problem.parameters()) {
    fmt::print("    --set {}={:.6g}{}{}: {}, {}{}\n", parameter.name, parameter.value,
               parameter.unit.empty() ? "" : " ", parameter.unit, parameter.meaning, parameter.range(),
               parameter.is_unknown ? "; an unknown, which starts at this guess" : "");
  }
}

int print_json(const nlohmann::ordered_json& json) {
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  return 0;
}

int print_text(std::string_view text) {
  fmt::print("{}", text);
  return 0;
}

int print_schema(const std::string& name) {
  if (name == "problems") return print_text(problem_cards_schema());
  if (name == "metadata") return print_text(metadata_schema());
  if (name == "claims") return print_json(row_schema("claims.csv", claims_table({})));
  if (name == "findings") return print_json(row_schema("findings.csv", findings_table({})));
  if (name == "claims_rows") return print_json(row_schema("claims_rows.csv", claims_rows_table({})));
  throw Error(
      fmt::format("--schema takes problems (for --json), metadata (for NAME.json), claims, findings or claims_rows "
                  "(for rows of these tables), not {}",
                  name));
}

void print_cards(const std::vector<std::shared_ptr<const Problem>>& problems) {
  nlohmann::ordered_json cards = nlohmann::ordered_json::array();
  for (const auto& problem : problems) cards.push_back(problem_card_json(*problem));
  print_json({{"dmocbench", describe_run({})["dmocbench"]}, {"problems", cards}});
}

/// The families as gnuplot code, which plots/style.gp reads.
int print_families() {
  const std::span<const Family> families = registered_families();
  const auto print_array = [&](const char* name, const auto& entry_of) {
    fmt::print("array {}[{}] = [", name, families.size());
    for (const Family& family : families) fmt::print("{}{}", &family == families.data() ? "" : ", ", entry_of(family));
    fmt::print("]\n");
  };
  fmt::print("# The families of methods as figures show them. Do not edit: written by\n");
  fmt::print("#   build/bench/list --families >plots/families.inc\n");
  fmt::print("families = \"{}\"\n", fmt::join(all_families(), " "));
  fmt::print("paper_families = \"{}\"\n", fmt::join(paper_families(), " "));
  print_array("family_labels", [](const Family& family) { return fmt::format("\"{}\"", family.label); });
  print_array("family_styles", [](const Family& family) { return family.style; });
  return 0;
}

/// Titles and units of the suite's problems as a table, which plots/style.gp reads.
void print_titles(const std::vector<std::shared_ptr<const Problem>>& problems) {
  fmt::print("problem,label,time_unit,state_unit,control_unit,momentum_unit,cost_unit,energy_unit\n");
  for (const auto& problem : problems) {
    const ProblemCard card = problem->card();
    const AxisUnits& units = card.axis_units;
    fmt::print("{},{},{},{},{},{},{},{}\n", problem->name(), card.title, card.time_unit.name, units.state,
               units.control, units.momentum, units.cost, units.energy);
  }
}

/// One line per problem: the name and the description in its card.
void print_briefly(const std::vector<std::shared_ptr<const Problem>>& problems) {
  for (const auto& problem : problems) fmt::print("{:<28} {}\n", problem->name(), problem->card().description);
}

std::vector<std::string> program_names() { return names_of(programs(), &Program::name); }

/// The names of a kind, a line each, for shells that complete them.
int print_names(const std::string& kind) {
  const std::vector<Named<std::vector<std::string> (*)()>> kinds{{"problem", problem_names},
                                                                 {"method", all_families},
                                                                 {"tableau", tableau_names},
                                                                 {"solver", solver_names},
                                                                 {"derivatives", derivative_back_end_names},
                                                                 {"integrator", explicit_integrator_names},
                                                                 {"program", program_names}};
  for (const std::string& name : value_named(kinds, kind, "--names: there is no kind")()) fmt::print("{}\n", name);
  return 0;
}

int print_all(CommandLine& line) {
  std::vector<std::string> names;
  std::vector<std::string> settings;
  line.group(group_of_problem);
  line.list("--problem", names, "print the complete statement of these problems");
  line.option("--set", settings, "set a parameter of a problem as PARAMETER=VALUE; may be repeated");
  line.group(group_of_output);
  bool as_json = false;
  std::string schema;
  line.flag("--json", as_json, "print the problems as JSON for other programs");
  line.option("--schema", schema,
              "print a JSON Schema: problems (for --json), metadata (for NAME.json), claims, findings or claims_rows "
              "(for rows of these tables)");
  bool as_gnuplot = false;
  line.flag("--families", as_gnuplot, "print the families of methods with labels and line styles for figures");
  bool as_titles = false;
  line.flag("--titles", as_titles, "print the titles and units of the problems as a table for figures");
  std::string kind;
  line.option("--names", kind,
              "print only the names of one kind, one per line: problem, method, tableau, solver, derivatives, "
              "integrator or program");
  line.example("--problem cart_pole");
  line.exit_code_1("");
  parse_with_libraries(line);
  if (!kind.empty()) return print_names(kind);
  if (as_gnuplot) return print_families();
  if (!schema.empty()) return print_schema(schema);
  std::vector<std::string> faults;
  const auto problems = selected_problems(names.empty() ? std::vector<std::string>{"all"} : names, settings, &faults);
  for (const std::string& fault : faults) fmt::print(stderr, "list: {}\n", one_line(fault));
  const int code = faults.empty() ? 0 : 2;
  if (as_json) print_cards(problems);
  if (as_titles) print_titles(problems);
  if (as_json || as_titles) return code;
  if (!names.empty()) {
    for (const auto& problem : problems) print_problem(*problem);
    return code;
  }
  fmt::print("Problems (--problem); list --problem NAME prints the complete statement of a problem\n\n");
  print_briefly(problems);
  fmt::print("\nMethods (--method)\n\n");
  for (const std::string& name : all_methods()) {
    fmt::print("{:<28} {}\n", name, make_element(name)->description());
  }
  fmt::print("\nTableaus (--tableau, --stages)\n\n");
  for (const std::string& name : tableau_names()) {
    fmt::print("{:<14} s = {}\n", name, fmt::join(tableau_stages(name), ", "));
  }
  fmt::print("\nSolvers (--solver)\n\n");
  for (const std::string& name : solver_names()) fmt::print("{:<14} {}\n", name, make_solver(name)->description());
  fmt::print("\nDerivatives (--derivatives)\n\n");
  for (const std::string& name : derivative_back_end_names()) {
    fmt::print("{:<20} {}\n", name, derivative_back_end_description(name));
  }
  return code;
}

int run(int argc, char** argv) {
  return run_program(
      "list", "Lists problems with their parameters and guesses, methods, tableaus, solvers and derivative back ends.",
      argc, argv, print_all);
}

}  // namespace dmocbench::list_program
