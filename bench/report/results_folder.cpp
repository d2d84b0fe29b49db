#include "bench/report/results_folder.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "bench/run/json_place.hpp"
#include "methods/error.hpp"
#include "methods/program/status.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder, const std::string& ending) {
  std::vector<std::filesystem::path> files;
  std::error_code none;  // a missing folder has no files
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() == ending && !path.filename().string().starts_with('.')) files.push_back(path);
  }
  std::ranges::sort(files);
  return files;
}

/// The motions that a run has written, according to its metadata; may be empty.
Json motions_of(const ReportedRun& run) {
  Json motions = run.metadata.value("motions", Json::array());
  if (!motions.is_array()) return Json::array();
  std::erase_if(motions.get_ref<Json::array_t&>(), [](const Json& motion) {
    const auto has_text = [&motion](const char* key) { return motion.contains(key) && motion.at(key).is_string(); };
    return !motion.is_object() || !has_text("nodes") || !has_text("problem") || !has_text("method");
  });
  return motions;
}

/// "motion_arm" of "motion_arm_nodes.csv", the table of a motion's nodes.
std::string stem_of_motion(const Json& motion) {
  constexpr std::string_view ending = "_nodes.csv";
  const std::string nodes = motion.at("nodes").get<std::string>();
  return nodes.ends_with(ending) ? nodes.substr(0, nodes.size() - ending.size()) : nodes;
}

/// The files of all motions.
std::set<std::string> files_of_motions(const std::vector<ReportedRun>& runs) {
  std::set<std::string> files;
  for (const ReportedRun& run : runs) {
    for (const Json& motion : motions_of(run)) {
      for (const char* const part :
           {"_nodes.csv", "_stages.csv", "_picture.csv", "_quantities.csv", "_constraints.csv"})
        files.insert(stem_of_motion(motion) + part);
    }
  }
  return files;
}

void read_motions(const std::filesystem::path& folder, ResultsFolder& results) {
  for (const ReportedRun& run : results.runs) {
    for (const Json& motion : motions_of(run)) {
      const std::string file = stem_of_motion(motion) + "_picture.csv";
      const Status status = status_named(motion.value("status", std::string(name_of(Status::solved))));
      if (!is_solved(status) && !is_no_motion(status)) continue;    // the last iterate of a failed solve
      if (std::filesystem::path(file).has_parent_path()) continue;  // all that a report shows is in its folder
      try {
        results.motions.push_back({motion.at("problem").get<std::string>(), motion.at("method").get<std::string>(),
                                   Table::from_csv(read_file(folder / file))});
      } catch (const Error& error) {
        results.faults.push_back(fmt::format("{}: {}", file, error.what()));
      }
    }
  }
}

/// Throws `Error` unless the metadata that every section reads have their types.
void require_types(const JsonPlace& metadata) {
  static_cast<void>(metadata.at("command_line").texts());
  if (metadata.has("complete")) static_cast<void>(metadata.at("complete").boolean());
  if (metadata.has("utc_time")) static_cast<void>(metadata.at("utc_time").text());
}

void read_runs(const std::filesystem::path& folder, ResultsFolder& results) {
  for (const std::filesystem::path& file : files_in(folder, ".json")) {
    try {
      Json metadata = json_in(read_file(file), file.filename().string());
      if (!metadata.is_object() || !metadata.contains("command_line")) continue;  // not a run's
      require_types({metadata, file.filename().string()});
      results.runs.push_back({file.stem().string(), std::move(metadata)});
    } catch (const Error& error) {
      results.faults.emplace_back(error.what());
    }
  }
}

/// The run whose metadata describe a table.
std::string run_of(const std::string& file, const std::vector<ReportedRun>& runs) {
  for (const ReportedRun& run : runs) {
    if (run.metadata.contains("tables") && run.metadata.at("tables").contains(file)) return run.name;
  }
  return "";
}

/// Throws `Error` unless a claim has all values that the report reads, with their types.
void require_claim(const JsonPlace& claim) {
  for (const char* const key : {"claim", "problem", "name", "where", "figure", "whose", "states", "verdict", "sure"})
    static_cast<void>(claim.at(key).text());
  for (const char* const key : {"evidence", "figures"}) static_cast<void>(claim.at(key).texts());
  for (const char* const key : {"measured", "reasons"}) {
    for (const JsonPlace& clause : claim.at(key).entries()) {
      static_cast<void>(clause.at("text").text());
      for (const JsonPlace& number : clause.at("numbers").entries()) {
        static_cast<void>(number.at("name").text() + number.at("method").text());
        static_cast<void>(number.at("value").number());
      }
    }
  }
  for (const JsonPlace& rows : claim.at("rows").entries()) {
    static_cast<void>(rows.at("table").text());
    static_cast<void>(rows.at("columns").texts());
    for (const JsonPlace& record : rows.at("records").entries()) static_cast<void>(record.count());
  }
}

/// Claims, then findings.
void read_claims(const std::filesystem::path& folder, ResultsFolder& results) {
  const std::string name = "claims.json";
  std::error_code none;
  if (!std::filesystem::exists(folder / name, none)) return;
  try {
    const Json json = json_in(read_file(folder / name), name);
    for (const char* const part : {"claims", "findings"}) {
      for (const JsonPlace& claim : JsonPlace(json, name).at(part).entries()) {
        require_claim(claim);
        results.claims.push_back(claim.json());
      }
    }
  } catch (const Error& error) {
    results.claims.clear();
    results.faults.emplace_back(error.what());
  }
}

void read_tables(const std::filesystem::path& folder, ResultsFolder& results) {
  std::set<std::string> others = files_of_motions(results.runs);
  others.insert({"claims.csv", "findings.csv", "claims_rows.csv"});  // claims.json has the same
  for (const std::filesystem::path& file : files_in(folder, ".csv")) {
    const std::string name = file.filename().string();
    try {
      if (!others.contains(name))
        results.tables.push_back({name, run_of(name, results.runs), Table::from_csv(read_file(file))});
    } catch (const Error& error) {
      results.faults.push_back(fmt::format("{}: {}", name, error.what()));
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
    throw Error("there is no results folder {0}; run an experiment with --out {0} first", folder.string());
  }
  ResultsFolder results;
  read_runs(folder, results);
  read_claims(folder, results);
  read_tables(folder, results);
  read_motions(folder, results);
  read_figures(folder, results);
  if (results.tables.empty() && results.figures.empty()) {
    throw Error("{} contains no table or figure; run an experiment with --out {} first", folder.string(),
                folder.string());
  }
  return results;
}

}  // namespace dmocbench
