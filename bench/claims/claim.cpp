#include "bench/claims/claim.hpp"

#include <array>
#include <cmath>

#include "bench/experiment/result_file.hpp"
#include "methods/error.hpp"

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

/// A misprint is confirmed if what is printed differs from what must hold by far more than rounding; the verdict on the
/// printed statement is then "differs".
JudgedClaim judge_misprint(const Row& row) {
  constexpr double tolerance = 1e-6;
  const double printed = row.number("value_as_printed", std::nan(""));
  const double required = row.number("required_value", std::nan(""));
  return {.id = row.text("problem") + "/" + row.text("slip"),
          .where = row.text("where"),
          .states = row.text("printed"),
          .measured = fmt::format("{}: {:.6g} as printed, {:.6g} as meant ({}), {:.6g} required", row.text("quantity"),
                                  printed, row.number("value_as_meant", std::nan("")), row.text("meant"), required),
          .verdict = verdict_on(std::abs(printed - required) < tolerance * std::max(1.0, std::abs(required)))};
}

}  // namespace

std::string_view name_of(ClaimVerdict verdict) noexcept {
  constexpr std::array names{"reproduced", "differs", "floor", "not yet"};
  return names[static_cast<std::size_t>(verdict)];
}

ResultTables ResultTables::read(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) throw Error(fmt::format("there is no folder {}", folder.string()));
  ResultTables tables;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path& path = entry.path();
    const bool is_temporary = path.filename().string().starts_with('.');
    if (path.extension() != ".csv" || path.stem() == "claims" || is_temporary) continue;
    try {
      tables.add(path.stem().string(), Table::from_csv(read_file(path)));
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", path.string(), error.what()));
    }
  }
  return tables;
}

Selection ResultTables::rows(std::string_view table) const {
  const auto found = tables_.find(table);
  return found == tables_.end() ? Selection() : Selection(found->second);
}

Selection midpoint(const Selection& rows, const std::string& method) {
  return rows.where("tableau", "gauss").where("stages", "1").where("method", method);
}

std::vector<JudgedClaim> judge_claims(const ResultTables& tables) {
  std::vector<JudgedClaim> judged;
  for (const Claims& chapter : chapters()) {
    for (const std::string& problem : problems_of(chapter)) {
      for (const Claim& claim : chapter) {
        if (std::ranges::find(claim.problems, problem) == claim.problems.end()) continue;
        const auto finding = claim.judge(tables, problem);
        if (!finding && claim.is_optional) continue;
        judged.push_back({.id = problem + "/" + claim.id,
                          .where = claim.where.on(problem),
                          .states = claim.states.on(problem),
                          .measured = finding ? finding->measured + claim.reason : "",
                          .verdict = finding ? finding->verdict : ClaimVerdict::not_yet});
      }
    }
  }
  for (const Row& misprint : tables.rows("slips")) judged.push_back(judge_misprint(misprint));
  return judged;
}

}  // namespace dmocbench
