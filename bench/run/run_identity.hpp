#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/run/experiment.hpp"

namespace dmocbench {

/// The properties that all parts of a run have in common: program, compiler, instruction set, libraries (of problems by
/// name and checksum), parameters of the problems, options, the cases, and the file that solves start
/// from. `metadata` describes the run (`describe_run`), `options` are `CommandLine::values_for_results`.
[[nodiscard]] nlohmann::ordered_json identity_of(const ExperimentCard& card, const std::vector<Case>& cases,
                                                 const nlohmann::ordered_json& metadata,
                                                 const std::map<std::string, std::string>& options);

/// The same of a run without cases.
[[nodiscard]] nlohmann::ordered_json identity_of(const std::string& experiment, const nlohmann::ordered_json& metadata,
                                                 const std::map<std::string, std::string>& options);

/// The keys of metadata that describe a machine.
inline constexpr std::array keys_of_machine{"processor", "cores", "memory_gib", "operating_system"};

/// The machine that a part ran on, from its metadata: those keys and "host".
[[nodiscard]] nlohmann::ordered_json machine_of(const nlohmann::ordered_json& metadata);

}  // namespace dmocbench
