#include "bench/run/problem_libraries.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string_view>

#include <nlohmann/json.hpp>

#include "bench/run/result_file.hpp"
#include "methods/error.hpp"
#include "problems/problem_library.hpp"
#include "problems/problem_registry.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

namespace {

/// Of this process, as the known problems are.
nlohmann::ordered_json& loaded_libraries() {
  static nlohmann::ordered_json libraries;
  return libraries;
}

void load(const std::filesystem::path& file) {
  std::error_code none;  // a missing file is rejected below
  const std::string path = std::filesystem::weakly_canonical(file, none).string();
  nlohmann::ordered_json& libraries = loaded_libraries();
  const auto is_loaded = [&path](const nlohmann::ordered_json& library) { return library.at("path") == path; };
  if (std::ranges::any_of(libraries, is_loaded)) return;
  const std::vector<std::string> known = problem_names();
  load_problem_library(file, known_problems());
  std::vector<std::string> problems = problem_names();
  problems.erase(problems.begin(), problems.begin() + std::ssize(known));
  libraries.push_back({{"path", path}, {"crc32", checksum_of(read_file(path))}, {"problems", problems}});
}

}  // namespace

std::vector<std::string> libraries_of_environment() {
  std::vector<std::string> libraries;
  const char* const value = std::getenv("DMOCBENCH_LIBRARIES");  // NOLINT(concurrency-mt-unsafe): it is never set here
  std::string_view rest = value == nullptr ? "" : value;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) libraries.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return libraries;
}

void add_library_option(CommandLine& line, std::vector<std::string>& libraries) {
  line.group(group_of_problem);
  line.option("--library", libraries,
              "shared library of problems, built by dmocbench_add_problems; may be repeated. Libraries in "
              "DMOCBENCH_LIBRARIES are loaded first",
              OptionRole::place);
}

void load_problem_libraries(const std::vector<std::string>& libraries) {
  for (const std::string& library : libraries_of_environment()) load(library);
  for (const std::string& library : libraries) {
    if (library.empty()) throw Error("--library: no file is named");
    load(library);
  }
}

std::vector<std::string> parse_with_libraries(CommandLine& line) {
  std::vector<std::string> libraries;
  add_library_option(line, libraries);
  std::vector<std::string> command_line = line.parse();
  load_problem_libraries(libraries);
  return command_line;
}

void note_source_of_problem(const std::string& problem, const std::string& file, const std::string& source) {
  nlohmann::ordered_json& libraries = loaded_libraries();
  const nlohmann::ordered_json problems{problem};
  for (std::size_t i = libraries.size(); i-- > 0;) {  // an earlier version
    if (libraries[i].at("path") == file && libraries[i].at("problems") == problems) libraries.erase(i);
  }
  libraries.push_back({{"path", file}, {"crc32", checksum_of(source)}, {"problems", problems}});
}

std::string library_of(const std::string& problem) {
  for (const nlohmann::ordered_json& library : loaded_libraries()) {
    const auto problems = library.at("problems").get<std::vector<std::string>>();
    if (std::ranges::find(problems, problem) != problems.end())
      return std::filesystem::path(library.at("path").get<std::string>()).filename().string();
  }
  return "";
}

nlohmann::ordered_json describe_problem_libraries() { return loaded_libraries(); }

}  // namespace dmocbench
