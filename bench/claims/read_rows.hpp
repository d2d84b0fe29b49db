#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// The rows of a table by which a claim was judged.
struct ReadRows {
  std::string table;                 ///< its file, without folder
  std::vector<std::size_t> records;  ///< of the rows whose numbers were read, in order; the header is record 1
  std::vector<std::string> columns;  ///< that were read of these rows, numbers and texts, by their names
};

/// The columns that were read, by the files of their tables, including columns used only to select rows.
[[nodiscard]] std::map<std::string, std::set<std::string>> read_columns(const ReadFields& fields);

/// The rows read, table by table. For a table from which only texts were read, the rows of these texts.
[[nodiscard]] std::vector<ReadRows> read_rows(const ReadFields& fields);

/// Whole numbers in order as a text: "2-5 9".
[[nodiscard]] std::string packed_ranges(const std::vector<std::size_t>& numbers);

}  // namespace dmocbench
