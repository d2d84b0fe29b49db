#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/run/part.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// The output of one part of a run, in one file, so that it is whole or absent: a line of JSON that describes it, then
/// a table of its rows, each with the number of its case in front. No program mistakes it for the table of a run.
struct PartFile {
  std::filesystem::path path;          ///< where it lies
  nlohmann::ordered_json description;  ///< the description of its run
  std::string table;                   ///< as comma-separated values

  /// Which part it is, according to the description.
  [[nodiscard]] Part part() const;
};

/// The folder of all parts of a run, NAME.parts next to its table NAME.csv. `prefix`: folder and name of the table.
[[nodiscard]] std::filesystem::path folder_of_parts(const std::filesystem::path& prefix);

/// Writes the file whole or not at all, and adds its checksum. Throws `Error` as `write_file` does.
void write_part(const PartFile& file);

/// Throws `Error` that names the file and the remedy if it cannot be read, is damaged or is not a part.
[[nodiscard]] PartFile read_part(const std::filesystem::path& path);

/// The parts of a run in some results folders, in the order of their numbers. Throws `Error` that names the part if one
/// is damaged, missing or present twice, or if the parts are not of the same run (by `identity` in their description);
/// also throws if there are no parts.
[[nodiscard]] std::vector<PartFile> read_all_parts(const std::vector<std::filesystem::path>& folders,
                                                   const std::string& name);

/// Throws `Error` with the difference between two runs: "parameters orbital_transfer revolutions is 3, not 2". The
/// message begins with `who`. Both are descriptions with a `commit`, which is only named, and an `identity`, which is
/// compared.
void require_same_run(const std::string& who, const nlohmann::ordered_json& description,
                      const nlohmann::ordered_json& wanted);

/// "3, 7 to 9": ascending numbers in words.
[[nodiscard]] std::string in_ranges(const std::vector<std::size_t>& numbers);

}  // namespace dmocbench
