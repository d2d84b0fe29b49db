#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// A run that wrote into a results folder, by its metadata.
struct ReportedRun {
  std::string name;
  nlohmann::ordered_json metadata;
};

/// A table of a results folder.
struct ReportedTable {
  std::string file;  ///< without folder
  std::string run;   ///< the run whose metadata describe it; may be empty
  Table table;
};

/// A figure, as gnuplot wrote it.
struct ReportedFigure {
  std::string name;  ///< without folder and ending
  std::string svg;
};

/// A motion's picture: where points are at the nodes.
struct ReportedMotion {
  std::string problem;
  std::string method;  ///< empty if no row names it
  Table picture;
};

/// All that a report shows of a results folder.
struct ResultsFolder {
  std::vector<ReportedRun> runs;
  std::vector<ReportedTable> tables;
  std::vector<ReportedFigure> figures;
  std::vector<ReportedMotion> motions;
  std::vector<nlohmann::ordered_json>
      claims;                       ///< as claims.json has them, then the findings; none if nothing was judged
  std::vector<std::string> faults;  ///< files that cannot be shown, a sentence each

  /// The metadata of a run, or null.
  [[nodiscard]] const nlohmann::ordered_json* metadata_of(const std::string& run) const;
};

/// Reads a folder, files in the order of their names. Throws `Error` if there is no such folder, or if it has no files
/// for a report.
[[nodiscard]] ResultsFolder read_results_folder(const std::filesystem::path& folder);

}  // namespace dmocbench
