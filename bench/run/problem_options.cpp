#include "bench/run/problem_options.hpp"

#include "bench/run/options.hpp"
#include "bench/run/problem_libraries.hpp"

namespace dmocbench {

void ProblemOptions::add_to(CommandLine& line) {
  line.list("--problem", problems, "problems, as `list` names them; all: every one");
  line.option("--set", settings, "parameter=value of a problem, as `list` shows them; may be repeated");
  add_library_option(line, libraries);
}

std::vector<std::shared_ptr<const Problem>> ProblemOptions::selected() const {
  load_problem_libraries(libraries);
  return selected_problems(problems, settings);
}

}  // namespace dmocbench
