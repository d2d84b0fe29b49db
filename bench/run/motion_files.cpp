#include "bench/run/motion_files.hpp"

#include <nlohmann/json.hpp>

#include "bench/run/described_tables.hpp"
#include "bench/run/problem_libraries.hpp"
#include "methods/program/status.hpp"
#include "methods/tables/motion_file.hpp"

namespace dmocbench {

std::vector<std::string> endings_of_motion_files() {
  return {"_stages.csv", "_picture.csv", "_quantities.csv", "_constraints.csv", "_nodes.csv"};
}

void write_motion(const std::filesystem::path& prefix, const SolvedCase& solved, nlohmann::ordered_json& metadata) {
  const Case& the_case = solved.the_case;
  const Problem& problem = *the_case.problem;
  const std::string file = prefix.string();
  write_table(file + "_stages.csv", stage_table(problem, *solved.trajectory), metadata);
  write_table(file + "_picture.csv", picture_table(problem, *solved.trajectory), metadata);
  write_table(file + "_quantities.csv", quantity_table(problem), metadata);
  if (const Table constraints = constraint_table(problem, *solved.trajectory); !constraints.columns().empty())
    write_table(file + "_constraints.csv", constraints, metadata);
  write_table(file + "_nodes.csv", node_table(problem, *solved.trajectory), metadata);
  metadata["motions"].push_back({{"nodes", std::filesystem::path(file + "_nodes.csv").filename().string()},
                                 {"problem", problem.name()},
                                 {"library", library_of(problem.name())},
                                 {"settings", problem.settings()},
                                 {"method", the_case.method},
                                 {"tableau", the_case.tableau},
                                 {"stages", the_case.stages},
                                 {"solver", the_case.solver},
                                 {"answered_by", solved.solution.solver},
                                 {"intervals", the_case.intervals()},
                                 {"status", name_of(solved.solution.status)},
                                 {"costates_are_estimated", solved.solution.multipliers_are_estimated}});
}

}  // namespace dmocbench
