// "It turns out that the optimization process performs in a faster and more robust way when providing the derivatives
// by automatic differentiation rather than via finite differences."
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/claims/claim_rows.hpp"
#include "bench/claims/predicates.hpp"
#include "bench/experiment/solve_case.hpp"

namespace dmocbench {

namespace {

/// How the solves with one back end went.
struct Record {
  int solves = 0;
  int solved = 0;
  std::vector<double> slowdowns;  ///< seconds of a solved row over those of the tape's

  [[nodiscard]] std::optional<double> median_slowdown() const {
    if (slowdowns.empty()) return std::nullopt;
    std::vector<double> sorted = slowdowns;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
  [[nodiscard]] std::string described() const {
    const auto median = median_slowdown();
    return fmt::format("{} of {}{}", solved, solves,
                       median ? fmt::format(" ({:.1f} times the tape's time)", *median) : "");
  }
};

/// The tape's row of the same method on the same grid.
const Row* tape_row(const Rows& rows, const Row& other) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row* row) {
    return row->text("derivatives") == "tape" && row->text("hessian") == "exact" && is_usable(*row) &&
           row->text("method") == other.text("method") && row->text("intervals") == other.text("intervals");
  });
  return found == rows.end() ? nullptr : *found;
}

Record record_of(const Rows& rows, const std::string& derivatives, const std::string& hessian) {
  Record record;
  for (const Row* row : rows_with(rows_with(rows, "derivatives", derivatives), "hessian", hessian)) {
    ++record.solves;
    if (!is_usable(*row)) continue;
    ++record.solved;
    const Row* exact = tape_row(rows, *row);
    const auto seconds = row->number("seconds");
    const auto seconds_of_tape = exact == nullptr ? std::nullopt : exact->number("seconds");
    if (seconds && seconds_of_tape) record.slowdowns.push_back(*seconds / *seconds_of_tape);
  }
  return record;
}

}  // namespace

Claim derivatives_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/automatic_differentiation",
              .where = "section 4.1",
              .paper = "faster and more robust than finite differences",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Rows rows = rows_with(tables.rows("derivatives", problem), "solver", "ipopt");
  const Record tape = record_of(rows, "tape", "exact");
  const Record adolc = record_of(rows, "adolc", "exact");
  const Record central = record_of(rows, "finite_differences", "exact");
  const Record forward = record_of(rows, "forward_differences", "exact");
  const Record forward_quasi_newton = record_of(rows, "forward_differences", "limited_memory");
  if (tape.solves == 0 || central.solves == 0 || forward.solves == 0) return claim;
  claim.measured = fmt::format(
      "solved to the tolerance: tape {} of {}, ADOL-C {}; central differences {}, forward {}, forward with a "
      "quasi-Newton "
      "Hessian {}",
      tape.solved, tape.solves, adolc.described(), central.described(), forward.described(),
      forward_quasi_newton.described());
  // More robust: exact derivatives never fail, differences do. Faster: where differences are solved too, they take
  // longer.
  const bool robust = tape.solved == tape.solves && adolc.solved == adolc.solves && central.solved < central.solves &&
                      forward.solved < forward.solves;
  const bool faster = central.median_slowdown().value_or(2.0) > 1.0 && forward.median_slowdown().value_or(2.0) > 1.0;
  claim.verdict = verdict_of(robust && faster);
  return claim;
}

Claim adolc_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/adolc_faster_than_differences",
              .where = "section 4.1",
              .paper = "faster, by the package ADOL-C",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Rows rows = rows_with(tables.rows("derivatives", problem), "solver", "ipopt");
  const auto adolc = record_of(rows, "adolc", "exact").median_slowdown();
  const auto central = record_of(rows, "finite_differences", "exact").median_slowdown();
  if (!adolc || !central) return claim;
  claim.measured = fmt::format(
      "solves take {:.1f} times the tape's time by ADOL-C, interval by interval, and {:.1f} times by central "
      "differences, "
      "where these are solved; the differences here cost one pass over all intervals per unknown of one interval",
      *adolc, *central);
  claim.verdict = verdict_of(*adolc < *central);
  return claim;
}

}  // namespace dmocbench
