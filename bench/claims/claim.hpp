#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/experiment/table.hpp"

namespace dmocbench {

/// What the measurement says of a statement of the paper.
enum class ClaimVerdict : std::uint8_t {
  reproduced,  ///< the predicate holds
  differs,     ///< the predicate does not hold
  floor,       ///< all that was measured is rounding: nothing can be said
  not_yet,     ///< there is no experiment for it, or its table is not there
};

/// "reproduced", "differs", "floor" or "not yet".
[[nodiscard]] std::string_view name_of(ClaimVerdict verdict) noexcept;

/// The tables of a results folder by their names without ".csv".
class ResultTables {
 public:
  ResultTables() = default;
  /// Reads every .csv of the folder but claims.csv. Throws `Error` that names a file that is no table.
  [[nodiscard]] static ResultTables read(const std::filesystem::path& folder);

  void add(const std::string& name, Table table) { tables_[name] = std::move(table); }
  /// The rows of a table; none if it is not there.
  [[nodiscard]] std::vector<const Row*> rows(std::string_view table) const;
  /// Those of one problem.
  [[nodiscard]] std::vector<const Row*> rows(std::string_view table, std::string_view problem) const;

 private:
  std::map<std::string, Table, std::less<>> tables_;
};

/// A row of the table of claims.
struct Claim {
  std::string id;        ///< "orbital_transfer/state_slope"
  std::string where;     ///< label or section in the paper
  std::string paper;     ///< what the paper states
  std::string measured;  ///< what was found, in words and numbers
  ClaimVerdict verdict = ClaimVerdict::not_yet;
};

}  // namespace dmocbench
