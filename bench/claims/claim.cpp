#include "bench/claims/claim.hpp"

#include <array>
#include <cmath>
#include <concepts>

namespace dmocbench {

namespace {

Claims joined(std::initializer_list<Claims> topics) {
  Claims all;
  for (const Claims& claims : topics) all.insert(all.end(), claims.begin(), claims.end());
  return all;
}

/// The claims in the order of the table: chapter by chapter, in each of them problem by problem.
std::vector<Claims> chapters() {
  return {joined({solution_claims(), grid_claims(), cost_claims()}),
          consistency_order_claims(),
          order_claims(),
          minima_claims(),
          joined({stage_control_claims(), coincidence_claims(), flow_claims()}),
          library_claims()};
}

std::vector<std::string> problems_of(const Claims& claims) {
  std::vector<std::string> problems;
  for (const Claim& claim : claims) {
    for (const std::string& problem : claim.problems) {
      if (std::ranges::find(problems, problem) == problems.end()) problems.push_back(problem);
    }
  }
  return problems;
}

/// What is found; "not yet", with what is lacking, where nothing can be found.
template <std::invocable Judge>
Finding finding_of(const Judge& judge) {
  try {
    return judge();
  } catch (const Error& lacking) {
    return {lacking.what(), ClaimVerdict::not_yet};
  }
}

/// A misprint is confirmed if what is printed differs from what must hold by far more than rounding; the verdict on the
/// printed statement is then "differs".
Finding judge_misprint(const Row& row) {
  constexpr double tolerance = 1e-6;
  const double printed = row.needed("value_as_printed");
  const double required = row.needed("required_value");
  return found(std::abs(printed - required) < tolerance * std::max(1.0, std::abs(required)),
               "{}: {:.6g} as printed, {:.6g} as meant ({}), {:.6g} required", row.text("quantity"), printed,
               row.needed("value_as_meant"), row.text("meant"), required);
}

/// The misprints of a table that is there; one row says so if it cannot be read.
std::vector<JudgedClaim> judge_misprints(const ResultTables& tables) {
  if (!tables.has("slips")) return {};
  std::vector<JudgedClaim> judged;
  try {
    for (const Row& row : tables.rows("slips")) {
      Finding finding = finding_of([&] { return judge_misprint(row); });
      judged.push_back({.id = row.text("problem") + "/" + row.text("slip"),
                        .where = row.text("where"),
                        .states = row.text("printed"),
                        .measured = std::move(finding.measured),
                        .verdict = finding.verdict});
    }
  } catch (const Error& fault) {
    judged.push_back({.id = "paper/slips", .where = "", .states = "(misprints)", .measured = fault.what()});
  }
  return judged;
}

}  // namespace

std::string_view name_of(ClaimVerdict verdict) noexcept {
  constexpr std::array names{"reproduced", "differs", "floor", "not yet"};
  return names[static_cast<std::size_t>(verdict)];
}

double quotient(const Row& row, const Row& other, const std::string& column) {
  const auto value = ratio(row.needed(column), other.needed(column));
  require(value.has_value(), "{}, column {}: a ratio needs a number above zero", other.place(), column);
  return *value;
}

std::string left_out(const Selection& all, const Selection& used, std::string_view why) {
  const Selection unused = all.where(
      [&](const Row& row) { return std::ranges::none_of(used, [&](const Row& kept) { return &kept == &row; }); });
  if (unused.empty()) return "";
  std::vector<std::string> favoured;
  for (const Selection& rows : unused.group_by({"method"})) {
    favoured.push_back(fmt::format("{} ({})", rows.front().text("method"), rows.size()));
  }
  return fmt::format("; {} of {} rows left out, {} {}", unused.size(), all.size(), why, fmt::join(favoured, ", "));
}

std::string unsolved_behind(const ResultTables& tables, std::string_view table, const Texts& wanted) {
  if (!tables.has(table)) return "";
  Selection solves = tables.rows(table);
  for (const auto& [column, text] : wanted) solves = solves.where(column, text);
  return left_out(solves, solves.usable());
}

Selection midpoint(const Selection& rows, const std::string& method) {
  return rows.where(is_midpoint).where("method", method);
}

std::vector<JudgedClaim> judge_claims(const ResultTables& tables) {
  std::vector<JudgedClaim> judged;
  for (const Claims& chapter : chapters()) {
    for (const std::string& problem : problems_of(chapter)) {
      for (const Claim& claim : chapter) {
        if (std::ranges::find(claim.problems, problem) == claim.problems.end()) continue;
        if (!claim.needs.empty() && !tables.has(claim.needs)) continue;
        Finding finding = finding_of([&] { return claim.judge(tables, problem); });
        if (finding.verdict != ClaimVerdict::not_yet) finding.measured += claim.reason;
        judged.push_back({.id = problem + "/" + claim.id,
                          .where = claim.where.on(problem),
                          .states = claim.states.on(problem),
                          .measured = std::move(finding.measured),
                          .verdict = finding.verdict});
      }
    }
  }
  const std::vector<JudgedClaim> misprints = judge_misprints(tables);
  judged.insert(judged.end(), misprints.begin(), misprints.end());
  return judged;
}

}  // namespace dmocbench
