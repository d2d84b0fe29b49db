#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/run/solve_case.hpp"

namespace dmocbench {

/// The endings that follow PREFIX in the names of a motion's files: "_nodes.csv", "_stages.csv" and so on.
[[nodiscard]] std::vector<std::string> endings_of_motion_files();

/// Writes the motion of a case, solved or as far as its solver came: PREFIX_nodes.csv (t, q, v, p, psi),
/// PREFIX_stages.csv (t, u), PREFIX_picture.csv, PREFIX_quantities.csv (units and bounds) and, where there are path
/// constraints, PREFIX_constraints.csv. The metadata get their columns, and an entry of "motions" that
/// names the case. The case has a trajectory. Throws `Error` if a file cannot be written.
void write_motion(const std::filesystem::path& prefix, const SolvedCase& solved, nlohmann::ordered_json& metadata);

}  // namespace dmocbench
