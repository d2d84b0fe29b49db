#include "bench/claims/claim_rows.hpp"

#include <algorithm>
#include <limits>

#include "bench/experiment/solve_case.hpp"

namespace dmocbench {

Rows rows_with(const Rows& rows, const std::string& column, const std::string& text) {
  Rows result;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(result),
               [&](const Row* row) { return row->text(column) == text; });
  return result;
}

Rows midpoint_rows(const Rows& rows, const std::string& method) {
  return rows_with(rows_with(rows_with(rows, "tableau", "gauss"), "stages", "1"), "method", method);
}

const Row* on_grid(const Rows& rows, double intervals) {
  for (const Row* row : rows) {
    if (row->number("intervals") == intervals && is_usable(*row)) return row;
  }
  return nullptr;
}

std::size_t count_unusable(const Rows& rows) {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const Row* row) { return !is_usable(*row); }));
}

double largest(const Rows& rows, const std::string& column) {
  double result = 0.0;
  for (const Row* row : rows) {
    result = std::max(result, row->number(column).value_or(std::numeric_limits<double>::infinity()));
  }
  return result;
}

}  // namespace dmocbench
