// How much of DMOC's saving belongs to the method, and how much to the solver: the same programs by solvers that know
// more or less of their structure.
#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "bench/experiment/command_line.hpp"
#include "bench/experiment/experiment.hpp"
#include "bench/structure_advantage/advantage_run.hpp"

int main(int argc, char** argv) try {
  using namespace dmocbench;  // NOLINT(google-build-using-namespace): the whole program is ours
  CommandLine line(
      "What collocation costs beside DMOC by Ipopt and by interior_point with its linear systems solved by intervals, "
      "as a band, or as any sparse matrix: iterations, linear systems, "
      "seconds, operations of a factorisation. NAME_ratios.csv sets them against DMOC at equal N and at equal error of "
      "the objective.",
      "structure_advantage");
  ExperimentOptions options;
  options.solvers = {"ipopt", "interior_point"};
  options.intervals = "64:1024";
  options.name = "structure_advantage";
  constexpr int rounds = 7;
  options.repeats = rounds;
  add_options(line, options);
  std::vector<std::string> factorisations = factorisation_names();
  line.option("--factorisation", factorisations, "how interior_point solves its linear systems")
      .comma_separated()
      .shows_default();
  return run_program(line, argc, argv, [&] {
    AdvantageRun run(options, factorisations, std::vector<std::string>(argv, argv + argc));
    const int code = run.run();
    fmt::print("structure_advantage: {}\n", run.summary());
    return code;
  });
} catch (const std::exception& error) {  // what is set up before run_program can guard it
  std::fputs(error.what(), stderr);
  return 2;
}
