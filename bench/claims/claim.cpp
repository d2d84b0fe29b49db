#include "bench/claims/claim.hpp"

#include <cmath>

namespace dmocbench {

/// The topics of the core, chapter by chapter (topics.cpp).
std::vector<std::vector<Claims (*)()>> topics_by_chapter();

namespace {

/// Chapters that `add_claims` has added.
std::vector<Claims>& added_chapters() {
  static std::vector<Claims> chapters;
  return chapters;
}

/// The claims in the order of the table: chapter by chapter, in each of them problem by problem.
std::vector<Claims> chapters() {
  std::vector<Claims> all;
  for (const auto& topics : topics_by_chapter()) {
    Claims& chapter = all.emplace_back();
    for (const auto& claims_of_topic : topics) std::ranges::move(claims_of_topic(), std::back_inserter(chapter));
  }
  all.insert(all.end(), added_chapters().begin(), added_chapters().end());
  return all;
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

/// The judge's finding, or "not judged" with the missing item if the judge throws.
template <std::invocable Judge>
Finding finding_of(const Judge& judge) {
  try {
    Finding finding = judge();
    if (std::ranges::all_of(finding.clauses, &Words::are_finite) && finding.reason.are_finite()) return finding;
    finding.clauses.insert(finding.clauses.begin(), {.text = "a number computed from the tables is not finite"});
    return {.clauses = std::move(finding.clauses), .sure = ""};
  } catch (const Error& lacking) {
    return {.clauses = {{.text = lacking.what()}}, .sure = ""};
  }
}

/// The same for a judge that reads tables. Columns are checked afterwards: a missing one reads as empty fields.
template <std::invocable Judge>
Finding finding_in(const ResultTables& tables, const ReadFields& fields, const Judge& judge) {
  Finding finding = finding_of(judge);
  return finding_of([&] {
    tables.require_columns(fields);
    return finding;
  });
}

bool is_equal(double value, double required) {
  constexpr double tolerance = 1e-6;
  return std::abs(value - required) < tolerance * std::max(1.0, std::abs(required));
}

/// A misprint is confirmed, and the printed statement "differs", if the printed value misses the required one by far
/// more than rounding and the corrected value does not. If both miss it, the intended statement is unknown.
Finding judge_misprint(const Row& row) {
  const double printed = row.needed("value_as_printed");
  const double meant = row.needed("value_as_meant");
  const double required = row.needed("required_value");
  ClaimVerdict verdict = is_equal(meant, required) ? ClaimVerdict::differs : ClaimVerdict::undecided;
  if (is_equal(printed, required)) verdict = ClaimVerdict::reproduced;
  const auto quantity = [&](double value, const char* at) {
    return Measurement{.name = row.text("quantity"), .value = value, .at = at};
  };
  return found(verdict, "{}: {:.6g} as printed, {:.6g} as intended, {:.6g} required", row.text("quantity"),
               quantity(printed, "as printed"), quantity(meant, "as meant"), quantity(required, "required"))
      .because(worded("the intended statement is {}", row.text("meant")));
}

/// The misprints in the table, if it exists; a single row with the error if it cannot be read.
std::vector<JudgedClaim> judge_misprints(const ResultTables& tables) {
  if (!tables.has("misprints")) return {};
  std::vector<JudgedClaim> judged;
  const auto append = [&](const std::string& problem, const std::string& name, const Row& row, Finding finding,
                          std::vector<ReadRows> rows = {}) {
    judged.push_back({.problem = problem,
                      .name = name,
                      .where = row.text("where"),
                      .figure = "",
                      .whose = Whose::misprint,
                      .states = row.text("printed"),
                      .clauses = std::move(finding.clauses),
                      .verdict = finding.verdict,
                      .reasons = {std::move(finding.reason)},
                      .evidence = {"misprints.csv"},
                      .sure = std::move(finding.sure),
                      .rows = std::move(rows)});
  };
  try {
    for (const Row& row : tables.rows("misprints")) {
      const ReadFields fields;
      Finding finding = finding_in(tables, fields, [&] { return judge_misprint(row); });
      append(row.text("problem"), row.text("misprint"), row, std::move(finding), read_rows(fields));
    }
  } catch (const Error& fault) {
    Row unread;
    unread.set("printed", "(misprints)");
    append("paper", "misprints", unread, {.clauses = {{.text = fault.what()}}, .sure = ""});
  }
  return judged;
}

/// The reasons written after a verdict: the cause if the claim differs, the condition, and the finding's own reason.
std::vector<Words> reasons_of(const Claim& claim, const std::string& problem, const Finding& finding) {
  if (finding.verdict == ClaimVerdict::not_judged) return {};
  std::vector<Words> reasons;
  if (finding.verdict == ClaimVerdict::differs) reasons.push_back({.text = claim.cause.on(problem)});
  reasons.push_back({.text = claim.condition.on(problem)});
  if (claim.by_counting) {
    reasons.push_back(
        {.text = "the statement follows from counting the unknowns or from a choice, so no solve can change it"});
  }
  reasons.push_back(finding.reason);
  std::erase_if(reasons, [](const Words& words) { return words.is_empty(); });
  return reasons;
}

/// The files of the evidence, with the problem's name in theirs.
std::vector<std::string> evidence_of(const Claim& claim, const std::string& problem) {
  std::vector<std::string> files = claim.evidence;
  const std::string placeholder = "{}";
  for (std::string& file : files) {
    if (const auto i = file.find(placeholder); i != std::string::npos) file.replace(i, placeholder.size(), problem);
  }
  return files;
}

std::string id_of(const Claim& claim, const std::string& problem) { return problem + "/" + claim.id; }

JudgedClaim judge_claim(const Claim& claim, const ResultTables& tables, const std::string& problem) {
  const ReadFields fields;
  Finding finding = finding_in(tables, fields, [&] { return claim.judge(tables, problem); });
  return {.problem = problem,
          .name = claim.id,
          .where = claim.where.on(problem),
          .figure = claim.figure.on(problem),
          .whose = claim.whose,
          .states = claim.states.on(problem),
          .clauses = std::move(finding.clauses),
          .verdict = finding.verdict,
          .reasons = reasons_of(claim, problem, finding),
          .evidence = evidence_of(claim, problem),
          .sure = std::move(finding.sure),
          .rows = read_rows(fields),
          .by_counting = claim.by_counting,
          .headline = claim.headline,
          .has_verdict = claim.has_verdict};
}

}  // namespace

std::string_view name_of(ClaimVerdict verdict) noexcept {
  constexpr std::array names{"reproduced", "differs", "undecided", "floor", "measured", "not judged"};
  return names[static_cast<std::size_t>(verdict)];
}

std::string_view name_of(Whose whose) noexcept {
  constexpr std::array names{"paper", "ours", "misprint", "extension"};
  return names[static_cast<std::size_t>(whose)];
}

ClaimVerdict verdict_on_interval(double lower, double upper, double band_lower, double band_upper) {
  if (lower > band_lower && upper < band_upper) return ClaimVerdict::reproduced;
  return lower > band_upper || upper < band_lower ? ClaimVerdict::differs : ClaimVerdict::undecided;
}

ClaimVerdict verdict_on_order(const Row& row, double expected, double near) {
  const double slope = row.needed("slope");
  const double half_width = 2.0 * row.needed("standard_error");
  return verdict_on_interval(slope - half_width, slope + half_width, expected - near, expected + near);
}

ClaimVerdict verdict_on_all(const std::vector<ClaimVerdict>& verdicts) {
  for (const ClaimVerdict decisive : {ClaimVerdict::differs, ClaimVerdict::undecided}) {
    if (std::ranges::count(verdicts, decisive) > 0) return decisive;
  }
  return ClaimVerdict::reproduced;
}

double quotient(const Row& numerator, const Row& denominator, const std::string& column) {
  if (const auto value = ratio(numerator.needed(column), denominator.needed(column))) return *value;
  throw Error("{}, column {}: a ratio needs positive numbers", denominator.place(), column);
}

Words left_out(const Selection& all, const Selection& used, std::string_view why) {
  const Selection unused = all.where(
      [&](const Row& row) { return std::ranges::none_of(used, [&](const Row& kept) { return &kept == &row; }); });
  if (unused.empty()) return {};
  std::vector<std::string> favoured;
  for (const Selection& rows : unused.group_by({"method"})) {
    const bool have_grids = std::ranges::count(rows.front().columns(), "intervals") > 0;
    const std::vector<std::string> grids = have_grids ? rows.distinct("intervals") : std::vector<std::string>();
    favoured.push_back(fmt::format("{} ({}{}{})", rows.front().text("method"), rows.size(),
                                   grids.empty() ? "" : ": N = ", fmt::join(grids, ", ")));
  }
  return worded("{} of {} rows left out: {} {}", unused.size(), all.size(), why, fmt::join(favoured, ", "));
}

Words unsolved_behind(const ResultTables& tables, std::string_view table, const Texts& wanted) {
  if (!tables.has(table)) return {};
  Selection solves = tables.rows(table);
  for (const auto& [column, text] : wanted) solves = solves.where(column, text);
  return left_out(solves, solves.usable());
}

Selection midpoint(const Selection& rows, const std::string& method) {
  return rows.where(is_midpoint).where("method", method);
}

Claims about(const Problems& problems, Whose whose, Claims claims) {
  for (Claim& claim : claims) {
    claim.problems = problems;
    claim.whose = whose;
  }
  return claims;
}

void add_claims(Claims claims) { added_chapters().push_back(std::move(claims)); }

std::vector<JudgedClaim> judge_claims(const ResultTables& tables) {
  return judge_claims(tables, [](const std::string&) { return true; });
}

std::vector<JudgedClaim> judge_claims(const ResultTables& tables,
                                      const std::function<bool(const std::string& id)>& is_chosen) {
  std::vector<JudgedClaim> judged;
  for (const Claims& chapter : chapters()) {
    for (const std::string& problem : problems_of(chapter)) {
      for (const Claim& claim : chapter) {
        if (std::ranges::find(claim.problems, problem) == claim.problems.end()) continue;
        if (!claim.needs.empty() && !tables.has(claim.needs)) continue;
        if (is_chosen(id_of(claim, problem))) judged.push_back(judge_claim(claim, tables, problem));
      }
    }
  }
  std::ranges::copy_if(judge_misprints(tables), std::back_inserter(judged), is_chosen, &JudgedClaim::id);
  return judged;
}

}  // namespace dmocbench
