// Statements of the paper that cannot be meant as printed.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claim_rows.hpp"
#include "bench/claims/predicates.hpp"
#include "bench/experiment/solve_case.hpp"

namespace dmocbench {

/// A slip is confirmed if what is printed differs from what must hold by far more than rounding; the verdict on the
/// printed statement is then "differs".
Claim slip_claim(const Row& row) {
  const double printed = row.number("value_as_printed").value_or(std::numeric_limits<double>::quiet_NaN());
  const double meant = row.number("value_as_meant").value_or(std::numeric_limits<double>::quiet_NaN());
  const double required = row.number("required_value").value_or(std::numeric_limits<double>::quiet_NaN());
  constexpr double tolerance = 1e-6;
  return {.id = row.text("problem") + "/" + row.text("slip"),
          .where = row.text("where"),
          .paper = row.text("printed"),
          .measured = fmt::format("{}: {:.6g} as printed, {:.6g} as meant ({}), {:.6g} required", row.text("quantity"),
                                  printed, meant, row.text("meant"), required),
          .verdict = verdict_of(std::abs(printed - required) < tolerance * std::max(1.0, std::abs(required)))};
}

}  // namespace dmocbench
