#include "bench/run/metadata.hpp"

#include <array>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <utility>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <boost/version.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/utsname.h>
#include <unistd.h>

#include "bench/run/build.hpp"
#include "bench/run/embedded_file.hpp"
#include "bench/run/problem_libraries.hpp"
#include "bench/run/result_file.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/instruction_set.hpp"
#include "methods/solvers/solver.hpp"

DMOCBENCH_EMBEDDED_FILE(metadata_schema, "bench/run/metadata.schema.json");

namespace dmocbench {

namespace {

/// When the program began: one program is one run.
const std::time_t begun = std::time(nullptr);
const Clock::time_point begun_by_clock = Clock::now();

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

double memory_in_gibibytes() {
  constexpr double bytes_per_gibibyte = 1024.0 * 1024.0 * 1024.0;
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE)) /
         bytes_per_gibibyte;
}

/// The commit of the source tree this program was built from, with "-dirty" if files differ from it.
std::string commit() {
  const std::string command = "git -C '" DMOCBENCH_SOURCE_DIR "' describe --always --dirty --abbrev=12 2>/dev/null";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::array<char, 128> line{};
  if (!pipe || std::fgets(line.data(), static_cast<int>(line.size()), pipe.get()) == nullptr) return "unknown";
  std::string text(line.data());
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::string operating_system() {
  utsname name{};
  return ::uname(&name) == 0 ? fmt::format("{} {} {}", name.sysname, name.release, name.machine) : "unknown";
}

}  // namespace

nlohmann::ordered_json describe_run(const std::vector<std::string>& command_line) {
  nlohmann::ordered_json description;
  description["command_line"] = command_line;
  description["utc_time"] = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(begun));
  description["commit"] = commit();
  description["dmocbench"] = version();
  description["compiler"] = compiler();
  description["flags"] = DMOCBENCH_FLAGS;
  description["instruction_set"] = std::string(name_of(preferred_instruction_set()));
  description["processor"] = processor();
  description["cores"] = ::sysconf(_SC_NPROCESSORS_ONLN);
  description["memory_gib"] = memory_in_gibibytes();
  description["operating_system"] = operating_system();
  description["software"] = {
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"Boost", BOOST_LIB_VERSION},
      {"fmt", FMT_VERSION},
      {"CLI11", CLI11_VERSION},
  };
  if (nlohmann::ordered_json libraries = describe_problem_libraries(); !libraries.is_null()) {
    description["problem_libraries"] = std::move(libraries);
  }
  for (const std::string& name : solver_names()) {
    description["solvers"][name] = make_solver(name)->description();
  }
  return description;
}

void write_metadata(const std::filesystem::path& file, const nlohmann::ordered_json& description) {
  nlohmann::ordered_json timed = description;
  // Parts ran elsewhere and at other times; the program that joins them does not know how long.
  if (!timed.contains("parts")) timed["wall_seconds"] = seconds_since(begun_by_clock);
  write_file(file, timed.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

std::string_view metadata_schema() noexcept { return dmocbench_file_metadata_schema; }

}  // namespace dmocbench
