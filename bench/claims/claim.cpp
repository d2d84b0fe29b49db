#include "bench/claims/claim.hpp"

#include <fmt/format.h>

#include "bench/experiment/result_file.hpp"
#include "methods/error.hpp"

namespace dmocbench {

std::string_view name_of(ClaimVerdict verdict) noexcept {
  switch (verdict) {
    case ClaimVerdict::reproduced:
      return "reproduced";
    case ClaimVerdict::differs:
      return "differs";
    case ClaimVerdict::floor:
      return "floor";
    case ClaimVerdict::not_yet:
      return "not yet";
  }
  return "unknown";
}

ResultTables ResultTables::read(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) throw Error(fmt::format("there is no folder {}", folder.string()));
  ResultTables tables;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path& path = entry.path();
    const bool is_temporary = path.filename().string().starts_with('.');
    if (path.extension() != ".csv" || path.stem() == "claims" || is_temporary) continue;
    try {
      tables.add(path.stem().string(), Table::from_csv(read_file(path)));
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", path.string(), error.what()));
    }
  }
  return tables;
}

std::vector<const Row*> ResultTables::rows(std::string_view table) const {
  std::vector<const Row*> result;
  if (const auto found = tables_.find(table); found != tables_.end()) {
    for (const Row& row : found->second.rows()) result.push_back(&row);
  }
  return result;
}

std::vector<const Row*> ResultTables::rows(std::string_view table, std::string_view problem) const {
  std::vector<const Row*> result;
  for (const Row* row : rows(table)) {
    if (row->text("problem") == problem) result.push_back(row);
  }
  return result;
}

}  // namespace dmocbench
