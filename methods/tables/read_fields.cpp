#include "methods/tables/read_fields.hpp"

#include <utility>

namespace dmocbench {

namespace {

thread_local ReadFields* innermost = nullptr;  // NOLINT(misc-use-internal-linkage): is internal

}  // namespace

ReadFields::ReadFields() : outer_(std::exchange(innermost, this)) {}

ReadFields::~ReadFields() { innermost = outer_; }

void note_read_field(const std::string& place, std::string_view column, bool is_number) {
  if (innermost == nullptr || place.empty()) return;
  ReadFields::ReadRow& row = innermost->rows_[place];
  row.has_number = row.has_number || is_number;
  if (!row.columns.contains(column)) row.columns.emplace(column);
}

}  // namespace dmocbench
