#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// The columns whose fields differ between rows, and the values of the others, as words. Of one row all differ.
struct SplitColumns {
  std::vector<std::string> differing;
  std::vector<std::string> constant;
};

/// Some of the columns of a table split like this.
[[nodiscard]] SplitColumns split_columns(const Table& table, const std::vector<std::string>& columns);

/// The meaning of a column, by a run's metadata, in words without its unit; empty if unknown or null.
[[nodiscard]] std::string meaning_in_words(const nlohmann::ordered_json* metadata, const std::string& file,
                                           const std::string& column);

/// The command line in a run's metadata; empty if missing or null.
[[nodiscard]] std::string command_of(const nlohmann::ordered_json* metadata);

/// Whether the row is a solve that ended otherwise than solved; for tables that have a status.
[[nodiscard]] bool is_unsolved(const Row& row);

/// The first rows of a table of a file, at most `most`, as a table of HTML that scrolls. Heads state units; rows of
/// solves that were not solved are marked.
[[nodiscard]] std::string rows_markup(const Table& table, const std::vector<std::string>& columns, std::size_t most,
                                      const nlohmann::ordered_json* metadata, const std::string& file);

}  // namespace dmocbench
