#include "bench/report/results_folder.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "bench/experiment/result_file.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder, const std::string& ending) {
  std::vector<std::filesystem::path> files;
  std::error_code none;  // a folder that is not there has none
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() == ending && !path.filename().string().starts_with('.')) files.push_back(path);
  }
  std::ranges::sort(files);
  return files;
}

/// "cart_pole" of "motion_cart_pole_picture"; empty of other names. `part` is "picture", "nodes" or "stages".
std::string problem_of_motion(const std::string& name, std::string_view part) {
  constexpr std::string_view begin = "motion_";
  const std::string end = fmt::format("_{}", part);
  if (!name.starts_with(begin) || !name.ends_with(end) || name.size() <= begin.size() + end.size()) return "";
  return name.substr(begin.size(), name.size() - begin.size() - end.size());
}

bool is_part_of_motion(const std::string& name) {
  return std::ranges::any_of(std::initializer_list<std::string_view>{"picture", "nodes", "stages"},
                             [&name](std::string_view part) { return !problem_of_motion(name, part).empty(); });
}

void read_runs(const std::filesystem::path& folder, ResultsFolder& results) {
  for (const std::filesystem::path& file : files_in(folder, ".json")) {
    Json metadata = Json::parse(read_file(file), nullptr, false);
    if (!metadata.is_object() || !metadata.contains("command_line")) continue;  // not a run's
    results.runs.push_back({file.stem().string(), std::move(metadata)});
  }
}

/// The run whose metadata tell of a table.
std::string run_of(const std::string& file, const std::vector<ReportedRun>& runs) {
  for (const ReportedRun& run : runs) {
    if (run.metadata.contains("tables") && run.metadata.at("tables").contains(file)) return run.name;
  }
  return "";
}

void read_tables(const std::filesystem::path& folder, ResultsFolder& results) {
  for (const std::filesystem::path& file : files_in(folder, ".csv")) {
    const std::string name = file.filename().string();
    try {
      Table table = Table::from_csv(read_file(file));
      if (name == "claims.csv") {
        results.claims = std::move(table);
      } else if (const std::string problem = problem_of_motion(file.stem().string(), "picture"); !problem.empty()) {
        results.motions.push_back({problem, "", std::move(table)});
      } else if (!is_part_of_motion(file.stem().string())) {
        results.tables.push_back({name, run_of(name, results.runs), std::move(table)});
      }
    } catch (const Error& error) {
      results.faults.push_back(fmt::format("{}: {}", name, error.what()));
    }
  }
  for (ReportedMotion& motion : results.motions) {
    for (const ReportedTable& table : results.tables) {
      if (table.file == "motion_" + motion.problem + ".csv" && !table.table.rows().empty())
        motion.method = table.table.rows().front().text("method");
    }
  }
}

void read_figures(const std::filesystem::path& folder, ResultsFolder& results) {
  for (const std::filesystem::path& file : files_in(folder / "figures", ".svg")) {
    try {
      results.figures.push_back({file.stem().string(), read_file(file)});
    } catch (const Error& error) {
      results.faults.push_back(fmt::format("{}: {}", file.filename().string(), error.what()));
    }
  }
}

}  // namespace

const Json* ResultsFolder::metadata_of(const std::string& run) const {
  const auto found = std::ranges::find(runs, run, &ReportedRun::name);
  return found == runs.end() ? nullptr : &found->metadata;
}

ResultsFolder read_results_folder(const std::filesystem::path& folder) {
  std::error_code none;
  if (!std::filesystem::is_directory(folder, none)) {
    throw Error(fmt::format("there is no results folder {}", folder.string()));
  }
  ResultsFolder results;
  read_runs(folder, results);
  read_tables(folder, results);
  read_figures(folder, results);
  if (results.tables.empty() && results.figures.empty()) {
    throw Error(fmt::format("there is no table and no figure in {}; run an experiment with --out {} first",
                            folder.string(), folder.string()));
  }
  return results;
}

}  // namespace dmocbench
