#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/report/results_folder.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The values that the templates of the page (plots/report) show, as JSON: facts and words, no HTML but the statements
/// of problems. Templates escape all texts.
using PageModel = nlohmann::ordered_json;

/// `groups` of the claims as claims.json has them, by section of the paper, then by whose they are: a statement about
/// several problems is one of the `entries`, with an item for each problem. `open` are the entries of the paper that
/// are not reproduced for all problems. Null without claims.
[[nodiscard]] PageModel claims_model(const ResultsFolder& results);

/// The answers to the questions of the first screen, in order: `question`, `answer`, what limits it (`but`), `number`
/// and `unit`, the verdicts on which it rests, and `cells`, a small picture of each of the paper's problems. A question
/// whose tables are missing is left out.
[[nodiscard]] PageModel answers_model(const ResultsFolder& results);

/// Lines for a folder without claims: fitted orders, cost on the finest grid and solves, by problem and method. Orders
/// of state, control, costate and cost come first, and so do the lines that have them.
[[nodiscard]] PageModel measured_model(const ResultsFolder& results);

/// For every problem of a convergence run: which method needs the fewest unknowns for the smallest state error that all
/// methods reach, and by how much, as a `text` with the `table` that it is computed from.
[[nodiscard]] PageModel recommendations_model(const ResultsFolder& results);

/// `problems` that the folder solves, each with its motions, statement, optimum and the methods that reach it; those
/// unknown to the program have a motion only. `others` counts the problems that are not there. Null if no motion was
/// written.
[[nodiscard]] PageModel gallery_model(const ResultsFolder& results);

/// The methods that tried a problem, by name: their rows in the runs that solve it as it is stated, the `solved` ones,
/// those `near` the optimum, whose cost differs by 1 % at most, and the smallest relative `difference` of a cost.
[[nodiscard]] PageModel reached_model(const ResultsFolder& results, const std::string& problem, double optimum);

/// The statement of a problem: `objective`, `formulas` and `shared` parts as lists of terms, `limits` (a place and its
/// conditions), all in MathML, and `letters` of the parameters with value, unit and meaning.
[[nodiscard]] PageModel statement_model(const Problem& problem);

/// The motions of one problem as a picture that stands still: a polyline for each point, a vertex per instant; where
/// the motions have no point in the plane, the first quantities over time. Null without a motion of at least two
/// instants.
[[nodiscard]] PageModel motion_model(const std::vector<const ReportedMotion*>& motions);

/// The figures by the section of the paper whose claims name them as evidence, the others by kind. `folder` is the path
/// from the page's folder to the results, for links to the files.
[[nodiscard]] PageModel figures_model(const ResultsFolder& results, const std::string& folder);

/// The tables by run, with links as in `figures_model`.
[[nodiscard]] PageModel tables_model(const ResultsFolder& results, const std::string& folder);

/// A table for the script of the page: `columns` with name and meaning, `rows` of texts, at most `most_rows` of them.
[[nodiscard]] PageModel table_json(const ReportedTable& reported, const nlohmann::ordered_json* metadata);

/// Rows of a table in the page; the others are in its file.
inline constexpr std::size_t most_rows = 1000;

/// Warnings, the extent of the comparison, machine, date, and the unsolved cases.
[[nodiscard]] PageModel run_model(const ResultsFolder& results);

/// The command line in a run's metadata, without the folders of absolute paths; empty without metadata.
[[nodiscard]] std::string command_of(const nlohmann::ordered_json* metadata);

/// Whether the row is a solve that ended otherwise than solved; for tables that have a status.
[[nodiscard]] bool is_unsolved(const Row& row);

/// "section 3.4" of a claim about "section 3.4, th:equi", the first of several sections.
[[nodiscard]] std::string section_of(const nlohmann::ordered_json& claim);

/// Whether a table has all of these columns.
[[nodiscard]] bool has_columns(const Table& table, std::initializer_list<std::string_view> names);

}  // namespace dmocbench
