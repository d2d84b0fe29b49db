// What there is: problems with their parameters and guess, methods, tableaus, solvers, derivative back ends.
#include <cstdio>
#include <exception>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/experiment/experiment.hpp"
#include "methods/error.hpp"
#include "methods/transcription/derivative_back_end.hpp"
#include "methods/transcription/element.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

namespace {

std::string listed(const Eigen::VectorXd& vector) { return fmt::format("({:.6g})", fmt::join(vector, ", ")); }

void print_problem(const Problem& problem) {
  const Unit time = problem.time_unit();
  const BoundaryState first = problem.initial_state();
  const BoundaryState last = problem.final_state();
  fmt::print("{}\n    {}\n", problem.name(), problem.description());
  fmt::print("    source    {}\n", problem.source());
  fmt::print("    q         ({})   u  ({})\n", fmt::join(problem.configuration_names(), ", "),
             fmt::join(problem.control_names(), ", "));
  fmt::print("    start     q = {}, v = {}\n", listed(first.q), listed(first.v));
  fmt::print("    end       q = {}, v = {}\n", listed(last.q), listed(last.v));
  fmt::print("    horizon   T = {:.6g} ({:.6g} {})\n", problem.horizon(), problem.horizon() * time.factor, time.name);
  fmt::print("    guess     {}\n", problem.guess_description());
  fmt::print("    scale     the cost is multiplied by {:g} for the solver\n", problem.cost_scale());
  for (const Parameter& parameter : problem.parameters()) {
    fmt::print("    --set {}={:.6g}{}{}: {}, {}\n", parameter.name, parameter.value, parameter.unit.empty() ? "" : " ",
               parameter.unit, parameter.meaning, parameter.range());
  }
}

int print_all(const std::vector<std::string>& names, const std::vector<std::string>& settings) {
  const auto problems = selected_problems(names.empty() ? std::vector<std::string>{"all"} : names,
                                          settings);  // refuses before anything is printed
  fmt::print("Problems (--problem)\n\n");
  for (const auto& problem : problems) {
    print_problem(*problem);
    fmt::print("\n");
  }
  if (!names.empty()) return 0;
  fmt::print("Methods (--method)\n\n");
  for (const std::string& name : element_names()) {
    fmt::print("{:<12} {}\n", name, make_element(name)->description());
  }
  fmt::print("\nTableaus (--tableau, --stages)\n\n");
  for (const std::string& name : tableau_names()) {
    fmt::print("{:<12} s = {}\n", name, fmt::join(tableau_stages(name), ", "));
  }
  fmt::print("\nSolvers (--solver)\n\n");
  for (const std::string& name : solver_names()) fmt::print("{:<12} {}\n", name, make_solver(name)->description());
  fmt::print("\nDerivatives (--derivatives)\n\n");
  for (const std::string& name : derivative_back_end_names()) {
    fmt::print("{:<20} {}\n", name, derivative_back_end_description(name));
  }
  return 0;
}

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) try {
  CLI::App app("What there is: problems with their parameters and guess, methods, tableaus, solvers, derivatives.",
               "list");
  std::vector<std::string> problems;
  std::vector<std::string> settings;
  app.add_option("--problem", problems, "only these problems")->delimiter(',');
  app.add_option("--set", settings, "parameter=value of a problem; may be repeated");
  return dmocbench::run_program(app, argc, argv, [&] { return dmocbench::print_all(problems, settings); });
} catch (const std::exception& error) {  // what is set up before run_program can guard it
  std::fputs(error.what(), stderr);
  return 2;
}
