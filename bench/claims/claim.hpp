#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/claims/result_tables.hpp"
#include "bench/claims/words.hpp"

namespace dmocbench {

/// The verdict of a measurement on a statement.
enum class ClaimVerdict : std::uint8_t {
  reproduced,  ///< the predicate holds
  differs,     ///< the predicate does not hold
  undecided,   ///< the interval of the measurement contains the threshold
  floor,       ///< the measurement is at the level of rounding: no verdict is possible
  measured,    ///< of a finding, which has no threshold: its numbers are the result
  not_judged,  ///< a table, a number or usable rows are missing
};
/// All verdicts, in the order of tables.
inline constexpr std::array all_verdicts{ClaimVerdict::reproduced, ClaimVerdict::differs,  ClaimVerdict::undecided,
                                         ClaimVerdict::floor,      ClaimVerdict::measured, ClaimVerdict::not_judged};

/// "reproduced", "differs", "undecided", "floor", "measured" or "not judged".
[[nodiscard]] std::string_view name_of(ClaimVerdict verdict) noexcept;

inline constexpr const char* orbit = "orbital_transfer";         ///< the paper's first problem
inline constexpr const char* two_link = "two_link_manipulator";  ///< the paper's second problem
inline constexpr const char* oscillator = "forced_oscillator";   ///< a problem with a constant mass matrix

/// The problems that a claim is about, each judged by itself.
using Problems = std::vector<std::string>;
inline const Problems of_paper{orbit, two_link};  ///< both problems of the paper
inline const Problems only_orbit{orbit};          ///< the first one
inline const Problems only_two_link{two_link};    ///< the second one
/// Takes the place of a problem in claims about simulated motions without optimization.
inline const Problems simulated{"simulations"};
/// The same where several small problems are solved for one statement.
inline const Problems examples{"examples"};

/// Who makes a statement.
enum class Whose : std::uint8_t {
  paper,      ///< the paper: its statements and remarks
  ours,       ///< a finding of ours: a sharper form of a statement, or one that the paper does not make
  misprint,   ///< a printed statement of the paper that differs from the intended one
  extension,  ///< about an extension of the suite, also where section 5 of the paper names the topic
};
/// All of them, in the order of the summary.
inline constexpr std::array all_sources{Whose::paper, Whose::ours, Whose::misprint, Whose::extension};

/// "paper", "ours", "misprint" or "extension".
[[nodiscard]] std::string_view name_of(Whose whose) noexcept;

/// A text of a claim: one for every problem, or one for each of the paper's.
class Wording {
 public:
  /// The same text for every problem; implicit, so that claims are written as lists.
  Wording(const char* all) : Wording(all, all) {}
  /// A text for each of the paper's problems.
  Wording(const char* on_orbit, const char* on_two_link) : on_orbit_(on_orbit), on_two_link_(on_two_link) {}
  /// The text for a problem.
  [[nodiscard]] std::string on(std::string_view problem) const {
    return problem == two_link ? on_two_link_ : on_orbit_;
  }

 private:
  const char* on_orbit_;
  const char* on_two_link_;
};

/// The result of judging a claim by the tables.
struct Finding {
  std::vector<Words> clauses;                       ///< what was measured: the answer, then further numbers
  ClaimVerdict verdict = ClaimVerdict::not_judged;  ///< the verdict that follows from it
  Words reason = {};           ///< the cause or condition that the tables show; written after the claim's own
  std::string sure = "exact";  ///< "exact", or the share of replicates with the same verdict

  /// The same with another clause, such as the rows left out; without words there is none.
  [[nodiscard]] Finding also(Words clause) && {
    if (!clause.is_empty()) clauses.push_back(std::move(clause));
    return std::move(*this);
  }
  /// The same with a reason.
  [[nodiscard]] Finding because(Words sentence) && {
    reason = std::move(sentence);
    return std::move(*this);
  }
  /// The same with the share of replicates that have this verdict.
  [[nodiscard]] Finding as_sure_as(std::string replicates) && {
    sure = std::move(replicates);
    return std::move(*this);
  }
};

/// Judges a claim about a problem. Throws `Error` that names the missing data; the claim is then "not judged".
using Predicate = std::function<Finding(const ResultTables& tables, const std::string& problem)>;

/// A row of the table of claims before it is judged. To add one, write it into an array of its topic.
struct Claim {
  std::string id;                ///< "state_slope"; the written table puts the problem in front
  Problems problems = of_paper;  ///< the problems that it is about
  Wording where;  ///< section or label in the paper; for our own statement, the place in the paper that it sharpens
  Wording figure = "";                ///< label of the paper's figure that shows it; "" if none does
  Whose whose = Whose::ours;          ///< who makes the statement
  Wording states;                     ///< the statement, in the words of its source
  Predicate judge;                    ///< computes the verdict
  Wording condition = "";             ///< the condition under which it holds; written for every verdict
  Wording cause = "";                 ///< why it differs; written only if it does
  std::vector<std::string> evidence;  ///< files of the results folder; "{}" stands for the problem
  bool by_counting = false;           ///< it follows from counting unknowns or from a choice: no solve can turn it
  bool headline = false;              ///< a finding that the summary of the written table states
  bool has_verdict = true;            ///< false of a finding without a threshold, which findings.csv has
  std::string needs = {};  ///< left out where this table is not there: the experiment is not part of every run
};

/// A row of the written table.
struct JudgedClaim {
  std::string problem;                              ///< "orbital_transfer"
  std::string name;                                 ///< "state_slope"
  std::string where;                                ///< section or label in the paper
  std::string figure;                               ///< label of the paper's figure
  Whose whose = Whose::paper;                       ///< who makes the statement
  std::string states;                               ///< the statement
  std::vector<Words> clauses;                       ///< the measurement, the answer first; or the missing data
  ClaimVerdict verdict = ClaimVerdict::not_judged;  ///< the predicate's verdict
  std::vector<Words> reasons;         ///< why it differs, the condition under which it holds, what the tables show
  std::vector<std::string> evidence;  ///< tables and figures
  std::string sure;                 ///< "exact", or the share of replicates with the same verdict; "" for "not judged"
  std::vector<ReadRows> rows = {};  ///< by which it was judged
  bool by_counting = false;         ///< it follows from counting unknowns or from a choice
  bool headline = false;            ///< the summary states it
  bool has_verdict = true;          ///< false of a finding, whose numbers are the result
  std::vector<std::string> missing = {};  ///< files of the evidence that are not there

  /// "orbital_transfer/state_slope"
  [[nodiscard]] std::string id() const { return problem + "/" + name; }
  /// The clauses as one sentence.
  [[nodiscard]] std::string measured() const { return joined(clauses, "; ").text; }
  /// The reasons as one sentence.
  [[nodiscard]] std::string reason() const { return joined(reasons, "; ").text; }
};

/// Every claim with its verdict, and the paper's misprints. Only rows that are solved on the wanted branch decide;
/// where too few are left the claim is not judged.
[[nodiscard]] std::vector<JudgedClaim> judge_claims(const ResultTables& tables);

/// The same for some claims only: those whose name in the written table ("orbital_transfer/state_slope") is chosen.
[[nodiscard]] std::vector<JudgedClaim> judge_claims(const ResultTables& tables,
                                                    const std::function<bool(const std::string& id)>& is_chosen);

/// Claims of one topic.
using Claims = std::vector<Claim>;
/// Claims about the same problems, made by the same.
[[nodiscard]] Claims about(const Problems& problems, Whose whose, Claims claims);

/// From now on `judge_claims` judges these claims too, in a chapter of their own at the end of the written table. For
/// extensions and for experiments of your own: call it in `main`, before a program runs.
void add_claims(Claims claims);

// Shared by the predicates.

/// A fitted order may miss its order by this much.
inline constexpr double near_order = 0.3;

/// The verdict itself.
[[nodiscard]] inline ClaimVerdict verdict_on(ClaimVerdict verdict) { return verdict; }
/// `reproduced` if a statement holds, otherwise `differs`.
[[nodiscard]] inline ClaimVerdict verdict_on(bool holds) {
  return holds ? ClaimVerdict::reproduced : ClaimVerdict::differs;
}

/// A finding with the formatted text; `outcome` is a verdict, or whether the statement holds.
template <class Outcome, class... Values>
[[nodiscard]] Finding found(Outcome outcome, fmt::format_string<Values...> words, Values&&... values) {
  return {{worded(words, std::forward<Values>(values)...)}, verdict_on(outcome)};
}

/// The verdict on "the measurement lies in a band" by its interval: `reproduced` inside, `differs` outside,
/// `undecided` across an end of the band. So a noisier measurement does not pass more easily.
[[nodiscard]] ClaimVerdict verdict_on_interval(double lower, double upper, double band_lower, double band_upper);

/// The same of the order that was fitted in a row, with the interval of two standard errors on either side and a band
/// of `near` around the expected order. Throws `Error` without slope or standard error.
[[nodiscard]] ClaimVerdict verdict_on_order(const Row& row, double expected, double near = near_order);

/// Whether a row of fitted orders has one that counts. Where finer grids contradict the range that it was fitted on,
/// errors are not asymptotic there: such an order neither supports nor refutes a claim, whatever it is.
[[nodiscard]] inline bool has_order(const Row& row) {
  return row.text("verdict") == "slope" && row.text("fine_end") != "orders";
}
/// Why a row has no order that counts: "floor", "few grids", "unsteady", or "not asymptotic".
[[nodiscard]] inline std::string why_without_order(const Row& row) {
  return row.text("verdict") == "slope" ? "not asymptotic" : row.text("verdict");
}

/// The verdict on all of several: one that differs decides, then one that is undecided.
[[nodiscard]] ClaimVerdict verdict_on_all(const std::vector<ClaimVerdict>& verdicts);

/// The verdict on all rows by a function that judges one.
template <std::invocable<const Row&> Judge>
[[nodiscard]] ClaimVerdict verdict_on_all(const Selection& rows, const Judge& judge) {
  std::vector<ClaimVerdict> verdicts;
  std::ranges::transform(rows, std::back_inserter(verdicts), judge);
  return verdict_on_all(verdicts);
}

/// Throws `Error` with the formatted message unless `is_there`: data that a claim needs are missing.
template <class... Values>
void require(bool is_there, fmt::format_string<Values...> words, Values&&... values) {
  if (!is_there) throw Error(fmt::format(words, std::forward<Values>(values)...));
}

/// The quotient of two numbers of rows. Throws `Error` if one is missing or the second is not positive.
[[nodiscard]] double quotient(const Row& numerator, const Row& denominator, const std::string& column);

/// Texts that rows have, by their columns.
using Texts = std::vector<std::pair<std::string, std::string>>;

/// How many rows a claim leaves out, of which methods, why, and which method this favours; no words if it uses all
/// rows: "2 of 24 rows left out: not solved on the required branch, which favours tangent (2: N = 8, 16)".
[[nodiscard]] Words left_out(const Selection& all, const Selection& used,
                             std::string_view why = "not solved on the required branch, which favours");

/// The same for the rows with these texts in the table of solves that the claim reads a summary of; no words if this
/// table does not exist.
[[nodiscard]] Words unsolved_behind(const ResultTables& tables, std::string_view table, const Texts& wanted);

/// Whether a row is of the midpoint rule.
[[nodiscard]] inline bool is_midpoint(const Row& row) {
  return row.text("tableau") == "gauss" && row.text("stages") == "1";
}
/// The rows of one method by the midpoint rule.
[[nodiscard]] Selection midpoint(const Selection& rows, const std::string& method);

}  // namespace dmocbench
