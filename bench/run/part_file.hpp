#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/run/part.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// What one part of a run leaves behind, in one file, so that it is whole or absent: a line of JSON that describes it,
/// then a table of its rows, each with the number of its case in front. No program takes that for the table of a run.
struct PartFile {
  std::filesystem::path path;          ///< where it lies
  nlohmann::ordered_json description;  ///< what it says of its run
  std::string table;                   ///< as comma-separated values

  /// Which part it is, as the description says.
  [[nodiscard]] Part part() const;
};

/// The folder of all parts of a run, NAME.parts beside its table NAME.csv. `prefix`: folder and name of the table.
[[nodiscard]] std::filesystem::path folder_of_parts(const std::filesystem::path& prefix);

/// Writes the file whole or not at all, with what it is known by again added to the description. Throws `Error` as
/// `write_file` does.
void write_part(const PartFile& file);

/// Throws `Error` that names the file, and how to mend it, if it cannot be read or is no part as it was written.
[[nodiscard]] PartFile read_part(const std::filesystem::path& path);

/// The parts of a run in some results folders, in the order of their numbers. Throws `Error` if there is none, one is
/// damaged, they are not of the same run (which is what `identity` in their description is for), one is there twice, or
/// one is missing; the sentence names it.
[[nodiscard]] std::vector<PartFile> read_all_parts(const std::vector<std::filesystem::path>& folders,
                                                   const std::string& name);

/// Throws `Error` that says in what two runs differ: "parameters orbital_transfer revolutions is 3, not 2". `who`
/// begins it. Both are descriptions with a `commit`, which is only named, and an `identity`, which is compared.
void require_same_run(const std::string& who, const nlohmann::ordered_json& description,
                      const nlohmann::ordered_json& wanted);

/// "3, 7 to 9": ascending numbers in words.
[[nodiscard]] std::string in_ranges(const std::vector<std::size_t>& numbers);

}  // namespace dmocbench
