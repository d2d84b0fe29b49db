#include "bench/run/run_identity.hpp"

#include <filesystem>

#include <boost/crc.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/result_file.hpp"
#include "bench/run/written_tables.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// Names, grids, tolerances and parameters of all cases.
std::string checksum_of(const std::vector<Case>& cases) {
  boost::crc_32_type crc;
  for (const Case& the_case : cases) {
    std::string text = fmt::format("{} {}", the_case.label(), the_case.tolerance.value_or(0.0));
    for (const Parameter& parameter : the_case.problem->parameters()) text += fmt::format(" {}", parameter.value);
    crc.process_bytes(text.data(), text.size());
    const Eigen::VectorXd times = the_case.grid.relative_times();
    crc.process_bytes(times.data(), static_cast<std::size_t>(times.size()) * sizeof(double));
  }
  return fmt::format("{:08x}", crc.checksum());
}

/// The checksums of problem libraries by their names without folder, which may differ between machines.
Json checksums_of(const Json& metadata) {
  Json checksums = Json::object();
  for (const Json& library : metadata.at("problem_libraries")) {
    const std::filesystem::path path = library.at("path").get<std::string>();
    checksums[path.filename().string()] = library.at("crc32");
  }
  return checksums;
}

Json parameters_of(const std::vector<Case>& cases) {
  Json parameters = Json::object();
  for (const Case& the_case : cases) {
    const std::string& name = the_case.problem->name();
    if (parameters.contains(name)) continue;
    parameters[name] = Json::object();
    for (const Parameter& parameter : the_case.problem->parameters())
      parameters[name][parameter.name] = parameter.value;
  }
  return parameters;
}

/// The program and what it was built with.
Json program_of(const std::string& experiment, const Json& metadata) {
  Json identity{{"experiment", experiment}};
  for (const char* const key : {"dmocbench", "compiler", "flags", "instruction_set", "libraries", "solvers"}) {
    identity[key] = metadata.at(key);
  }
  // Not the commit: a tree that was changed has several programs under one, and one program outlives many.
  identity["program"] = fmt::format("{:08x}", crc_32(read_file("/proc/self/exe")));
  if (metadata.contains("problem_libraries")) identity["problem_libraries"] = checksums_of(metadata);
  return identity;
}

}  // namespace

Json identity_of(const std::string& experiment, const Json& metadata,
                 const std::map<std::string, std::string>& options) {
  Json identity = program_of(experiment, metadata);
  identity["options"] = options;
  return identity;
}

Json identity_of(const ExperimentCard& card, const std::vector<Case>& cases, const Json& metadata,
                 const std::map<std::string, std::string>& options) {
  Json identity = program_of(card.name, metadata);
  identity["parameters"] = parameters_of(cases);  // before the options: a difference is reported by its first entry
  identity["options"] = options;
  const std::string& start = card.options.start;
  std::error_code none;  // a start that is not a file is rejected where it is read
  if (start != "common" && start != "guess" && std::filesystem::is_regular_file(start, none))
    identity["start"] = fmt::format("{:08x}", crc_32(read_file(start)));
  identity["cases"] = cases.size();
  identity["checksum_of_cases"] = checksum_of(cases);
  return identity;
}

Json machine_of(const Json& metadata) {
  Json machine{{"host", host_name()}};
  for (const char* const key : keys_of_machine) machine[key] = metadata.at(key);
  return machine;
}

}  // namespace dmocbench
