#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// A table of a run, and the file that holds it.
struct TableFile {
  std::filesystem::path file;       ///< with its folder, NAME.csv
  Table table;                      ///< with the meanings of its columns
  std::ptrdiff_t not_measured = 0;  ///< rows that state why they lack a number
};

/// The stages of a run that are over, and the tables as they were then, in a file NAME.unfinished. An interrupted run
/// of the same identity continues from there. The file names its tables without a folder, because it may be a copy in
/// another folder, or made by others: tables are always written next to it.
class FinishedStages {
 public:
  FinishedStages() = default;
  /// Stages of a run with this file and identity (`identity_of`); none are over.
  FinishedStages(std::filesystem::path file, nlohmann::ordered_json identity)
      : file_(std::move(file)), identity_(std::move(identity)) {}

  /// Whether a stage is over.
  [[nodiscard]] bool contain(const std::string& stage) const;
  /// How many stages are over.
  [[nodiscard]] std::size_t count() const noexcept { return names_.size(); }
  /// Takes over the stages of a file of this very identity, and returns their tables. A file that is missing, damaged
  /// or of another run has none. Throws `Error` if it names a table that this run cannot have made.
  [[nodiscard]] std::vector<TableFile> resume();
  /// Adds a stage, and writes the file with all tables. Throws `Error` if it cannot be written.
  void add(const std::string& stage, const std::vector<TableFile>& tables);
  /// Removes the file.
  void forget() const;

 private:
  std::filesystem::path file_;
  nlohmann::ordered_json identity_;
  std::vector<std::string> names_;
};

}  // namespace dmocbench
