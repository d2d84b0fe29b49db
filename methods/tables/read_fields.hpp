#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace dmocbench {

/// As long as it exists, records the fields that this thread reads, of rows with a place
/// (`Table::name_places`): the data of a conclusion from tables. The innermost one records.
class ReadFields {
 public:
  /// The fields read of a row.
  struct ReadRow {
    std::set<std::string, std::less<>> columns;  ///< their names
    bool has_number = false;                     ///< a field was read as a number, not only to choose the row
  };
  /// Fields by the places of rows.
  using ByPlace = std::map<std::string, ReadRow, std::less<>>;

  /// Begins to record.
  ReadFields();
  ~ReadFields();
  ReadFields(const ReadFields&) = delete;
  ReadFields& operator=(const ReadFields&) = delete;
  ReadFields(ReadFields&&) = delete;
  ReadFields& operator=(ReadFields&&) = delete;

  /// The fields read since it was made.
  [[nodiscard]] const ByPlace& rows() const noexcept { return rows_; }

 private:
  friend void note_read_field(const std::string& place, std::string_view column, bool is_number);
  ByPlace rows_;
  ReadFields* outer_;
};

/// Records the read in this thread's innermost `ReadFields`, if there is one; rows without a place are ignored.
void note_read_field(const std::string& place, std::string_view column, bool is_number);

}  // namespace dmocbench
