#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "bench/run/case_list.hpp"
#include "bench/run/solve_case.hpp"
#include "methods/solvers/batch/solve_batch.hpp"
#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// The answers of one program that solves from many starts end at, each judged once.
///
/// Solves that end at one optimum differ within their tolerance. An answer is rounded, every unknown and every
/// multiplier to a hundred-thousandth of the largest of its kind along the horizon, and Newton steps lead from there to
/// the optimum that is judged. So the judgement of an answer depends on the answer alone, not on answers before it. If
/// these steps do not lead back to an answer within the tolerance of `settled`, it is judged by itself.
class KnownAnswers {
 public:
  /// The optimum of this solved case, judged; null where it has to be judged by itself. All cases must have the same
  /// problem, program and tolerance.
  [[nodiscard]] std::shared_ptr<JudgedAnswer> find(const SolvedCase& solved);

 private:
  std::map<std::vector<double>, std::shared_ptr<JudgedAnswer>> answers_;  // by the rounded one
};

/// A case of a batch on its way.
struct BatchedCase {
  std::size_t number = 0;                           ///< of the case, for the caller
  const Case* the_case = nullptr;                   ///< the case to be solved
  Start start;                                      ///< where it begins
  BatchInstance instance = {};                      ///< the same as a batch takes it
  std::optional<Solution> solution = std::nullopt;  ///< empty if the batch did not solve it: it must be solved alone
};

/// Cases that are instances of one program, from different starts or with other parameters and ends, solved side by
/// side (`solve_batch`). The program is made once. The result of a case does not depend on its neighbours.
class CaseBatch {
 public:
  /// Whether batches support a case's settings: `interior_point` by itself or as the first of `auto`, exact
  /// derivatives, the Bolza form, no limit of time, no trace of iterations. `solve` checks whether the program fits.
  [[nodiscard]] static bool takes(const Case& the_case, const SolverOptions& options);
  /// Whether two cases differ only in starts, parameters and ends.
  [[nodiscard]] static bool share_program(const Case& a, const Case& b);

  /// The program of all cases that share it with this one. Throws `Error` as `Case::transcribe` does.
  CaseBatch(const Case& any, SolverOptions options);

  /// Solves cases from their starts. Those that the batch cannot take are left without a solution: all of them where
  /// the program does not fit (`is_refused`), else the ones whose parameters formulas or bounds contain.
  void solve(std::span<BatchedCase> cases);
  /// True if the program does not fit a batch, so that no case was solved.
  [[nodiscard]] bool is_refused() const noexcept { return is_refused_; }

  /// The judged case of one that was solved. It refers to the program, which has the values of this case until the next
  /// one is requested.
  [[nodiscard]] SolvedCase judged_case(const BatchedCase& one);

 private:
  [[nodiscard]] bool fill(BatchedCase& one);
  void give_values_of(const Case& the_case);
  [[nodiscard]] bool has_usual_bounds() const;

  SolverOptions options_;
  std::shared_ptr<const Problem> problem_;  // the program refers to it
  std::shared_ptr<Transcription> program_;
  bool has_instances_;  // other parameters and ends
  Eigen::VectorXd usual_parameters_;
  double usual_horizon_;
  Eigen::VectorXd usual_lower_;  // of unknowns and rows
  Eigen::VectorXd usual_upper_;
  KnownAnswers answers_;
  bool is_refused_ = false;
};

/// Spans of problems, cut where one program ends and the next begins, each for its own process: cases that batches
/// leave to be solved and judged one by one then need not wait for other programs. Spans are never cut inside a group
/// (`groups_of`), and no piece has fewer than `least` cases.
[[nodiscard]] std::vector<CaseSpan> spans_of_programs(const std::vector<Case>& cases,
                                                      const std::vector<CaseSpan>& problems,
                                                      const std::vector<std::size_t>& groups, std::size_t least = 256);

/// The data of a run that its batches need.
struct BatchWork {
  const std::vector<Case>& cases;           ///< in the order of rows
  const std::vector<bool>& is_wanted;       ///< per case
  const SolverOptions& options;             ///< of every solve
  std::function<Start(const Case&)> start;  ///< throws `Error` where a case has none
  /// Called with every answer and the number of its case.
  std::function<void(SolvedCase& solved, std::size_t number)> keep;
  std::function<void(const std::string& activity)> show;  ///< called with a description of the current work
};

/// Solves the wanted cases that batches support, program after program, and keeps the solved ones. Cases that are not
/// kept must be solved alone and then report the reason. Interrupted solves are not kept. Cases of one program are
/// solved group after group, so that finished ones are kept early and memory is bounded.
void solve_in_batches(const BatchWork& work, const CaseSpan& span);

}  // namespace dmocbench
