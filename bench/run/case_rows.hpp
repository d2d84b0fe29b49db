#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/run/row_store.hpp"
#include "bench/run/run_plan.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// The rows of the cases of a run, in memory and in its store.
///
/// An entry of the store is {"case": number from 1, "row": fields in the order of the columns}, with "findings" after a
/// case that found an indirect solution to compare with. Of two entries of a case the later one counts.
class CaseRows {
 public:
  /// No rows. `columns`: of the table. `store`: not yet read. The experiment receives the findings of entries that are
  /// read.
  CaseRows(Experiment& experiment, std::size_t cases, std::vector<std::string> columns, RowStore store);

  /// The rows that are there in the order of the cases.
  [[nodiscard]] Table table() const;
  /// Whether the row of a case is there.
  [[nodiscard]] bool contain(std::size_t number) const { return rows_[number].has_value(); }
  /// Keeps the row of a case.
  void keep(std::size_t number, Row row);
  /// Takes over the rows of an interrupted run of the same identity, and returns how many. A row is made again if
  /// another one of its group (`RunPlan::groups_of_rows`) is missing. Throws `Error` if the store is damaged.
  std::size_t resume(const std::vector<std::size_t>& groups);
  /// Makes this the process that works on some rows for another one, which collects them from this file.
  void write_to(const std::filesystem::path& file) { store_ = RowStore(file, store_.header()); }
  /// Keeps the rows that another process has written to a file, which is removed; returns their numbers.
  std::vector<std::size_t> collect(const std::filesystem::path& file);
  /// Takes the rows of all cases from the stores of parts in `options().join`, and describes their origin in the
  /// metadata. Throws `Error` that names the store if one is damaged, of another run, or has a case that another one
  /// has, and `Error` that names the missing parts if there are any.
  void join(const RunPlan& plan, nlohmann::ordered_json& metadata);
  /// Waits until all rows are on the disk.
  void sync() { store_.sync(); }
  /// Removes the store.
  void remove_store() const { store_.remove(); }

 private:
  [[nodiscard]] nlohmann::ordered_json entry_of(std::size_t number, const Row& row) const;
  std::vector<std::size_t> take(const StoredEntries& stored);
  void require_all(const RunPlan& plan, std::size_t parts) const;

  Experiment& experiment_;
  std::vector<std::string> columns_;
  std::vector<std::optional<Row>> rows_;
  RowStore store_;
  nlohmann::ordered_json findings_;  ///< that the store has
};

/// "3, 7 to 9": ascending numbers in words.
[[nodiscard]] std::string in_ranges(const std::vector<std::size_t>& numbers);

}  // namespace dmocbench
