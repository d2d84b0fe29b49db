#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/claims/claim.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// The claims that have a verdict as claims.csv has them, a row each in their order.
[[nodiscard]] Table claims_table(const std::vector<JudgedClaim>& claims);

/// The findings without a verdict as findings.csv has them.
[[nodiscard]] Table findings_table(const std::vector<JudgedClaim>& claims);

/// The table rows that each claim and each finding is based on, written as claims_rows.csv: one row per claim and
/// table, with the records and columns that were read ("2-5 9", the header is record 1).
[[nodiscard]] Table claims_rows_table(const std::vector<JudgedClaim>& claims);

/// All of it as claims.json has it, for programs: under "claims" every claim, under "findings" every finding, with the
/// clauses of its measurement and its reasons, each a text with the numbers in it (name, value, method, case, unit),
/// and with the rows by which it was judged.
[[nodiscard]] nlohmann::ordered_json claims_json(const std::vector<JudgedClaim>& claims);

/// The claims for readers: the paper's statements, its remarks, our findings and the misprints, each in its own table
/// below a heading, then the closing lines.
[[nodiscard]] std::string claims_markdown(const std::vector<JudgedClaim>& claims);

/// How many claims have which verdict, a line for the paper's statements, its remarks, ours and the misprints:
/// "the paper's statements: 21 reproduced, 4 differ". Groups without claims have no line.
[[nodiscard]] std::vector<std::string> closing_lines(const std::vector<JudgedClaim>& claims);

/// The first section of the paper that a place names: "section 2.2" of "sections 2.2 and 3.4, equ_L_RK"; the part
/// before the first comma where none is named.
[[nodiscard]] std::string section_in(std::string_view where);

/// How many of the paper's statements have which verdict, section by section: "section 3.4: 4 reproduced, 1 undecided".
[[nodiscard]] std::vector<std::string> section_lines(const std::vector<JudgedClaim>& claims);

/// Finds the files of each claim's evidence that are missing from a results folder.
void mark_missing_evidence(std::vector<JudgedClaim>& claims, const std::filesystem::path& folder);

/// Claims that are not reproduced, a sentence each, of those with certain names. Throws `Error` on a name that no claim
/// has.
[[nodiscard]] std::vector<std::string> not_reproduced(const std::vector<JudgedClaim>& claims,
                                                      const std::vector<std::string>& names);

}  // namespace dmocbench
