#include "bench/run/case_batch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bench/run/interrupt.hpp"
#include "methods/error.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/judgement/newton_correction.hpp"
#include "methods/judgement/polish.hpp"
#include "methods/program/status.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/lane_transcription.hpp"
#include "methods/transcription/start.hpp"

namespace dmocbench {

namespace {

constexpr int bits_kept = 17;  // 2^-17 is a hundred-thousandth

/// The entries of one kind, rounded as the largest of them is; those that are smaller than all that counts are zero.
void round_run(Eigen::Ref<Eigen::VectorXd> entries, double largest_of_all) {
  const double largest =
      std::max(entries.lpNorm<Eigen::Infinity>(), NewtonCorrections::smallest_share * largest_of_all);
  if (!(largest > 0.0) || !std::isfinite(largest)) return;
  const double unit = std::ldexp(1.0, std::ilogb(largest) - bits_kept);
  entries = unit * (entries / unit).array().round().matrix();
}

Eigen::VectorXd rounded(Eigen::VectorXd vector, const Places& places) {
  const double largest = vector.size() > 0 ? vector.lpNorm<Eigen::Infinity>() : 0.0;
  for (const PlaceRun& run : places.runs()) {
    round_run(vector.segment(static_cast<Eigen::Index>(run.first), static_cast<Eigen::Index>(run.count)), largest);
  }
  return vector;
}

/// True if no unknown of one kind differs by more than `settled` of the largest of them.
bool is_near(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Places& places) {
  const double least = NewtonCorrections::smallest_share * a.lpNorm<Eigen::Infinity>();
  return std::ranges::all_of(places.runs(), [&](const PlaceRun& run) {
    const auto entries = Eigen::seqN(static_cast<Eigen::Index>(run.first), static_cast<Eigen::Index>(run.count));
    const double size = std::max(a(entries).lpNorm<Eigen::Infinity>(), least);
    return (a(entries) - b(entries)).lpNorm<Eigen::Infinity>() <= settled * size;
  });
}

/// The optimum that Newton steps from a rounded answer converge to, judged; null if they do not converge.
std::shared_ptr<JudgedAnswer> judged_optimum(const SolvedCase& solved, Solution optimum) {
  Transcription& program = *solved.program;
  optimum.primal = optimum.primal.cwiseMax(program.variable_lower()).cwiseMin(program.variable_upper());
  judge_residuals(program, optimum);
  polish(program, optimum);
  confirm(program, solved.tolerance, optimum);
  if (!is_solved(optimum.status)) return nullptr;
  SolvedCase judged{.the_case = solved.the_case, .program = solved.program, .solution = std::move(optimum)};
  judged.start = solved.start;
  judged.tolerance = solved.tolerance;
  judge_case(judged, {}, {});
  return std::make_shared<JudgedAnswer>(JudgedAnswer{std::move(judged)});
}

}  // namespace

std::shared_ptr<JudgedAnswer> KnownAnswers::find(const SolvedCase& solved) {
  const Solution& solution = solved.solution;
  const IntervalStructure* const structure = solved.program->interval_structure();
  const bool is_plain = is_solved(solution.status) && solution.message == sentence_of(Status::solved);
  if (!is_plain || structure == nullptr) return nullptr;
  Solution optimum = solution;
  optimum.primal = rounded(solution.primal, structure->unknowns);
  optimum.multipliers = rounded(solution.multipliers, structure->rows);
  std::vector<double> key(optimum.primal.begin(), optimum.primal.end());
  key.insert(key.end(), optimum.multipliers.begin(), optimum.multipliers.end());
  const auto [entry, is_new] = answers_.try_emplace(std::move(key));
  if (is_new) entry->second = judged_optimum(solved, std::move(optimum));
  const std::shared_ptr<JudgedAnswer>& answer = entry->second;
  const bool is_right = answer && is_near(solution.primal, answer->judged.solution.primal, structure->unknowns);
  return is_right ? answer : nullptr;
}

namespace {

const std::shared_ptr<const Problem>& program_problem(const Case& the_case) {
  return the_case.nominal ? the_case.nominal : the_case.problem;
}

/// The varied parameters that can be kept open: no formula reads them as numbers.
OpenParameters openable(const Problem& problem, const std::vector<std::string>& varied) {
  if (varied.empty()) return {};
  const TracedProblem traced(problem);
  OpenParameters open;
  for (const std::string& name : varied) {
    const std::size_t number = parameter_number(problem, name);
    const bool is_unread = !traced.are_constants()[number] && !problem.parameters()[number].whole;
    if (is_unread || std::ranges::count(traced.varying_parameters(), name) > 0) open.names.push_back(name);
  }
  return open;
}

/// Bounds of all unknowns, followed by the bounds of all rows.
Eigen::VectorXd joined(const Eigen::VectorXd& unknowns, const Eigen::VectorXd& rows) {
  Eigen::VectorXd both(unknowns.size() + rows.size());
  both << unknowns, rows;
  return both;
}
Eigen::VectorXd lower_bounds(const Transcription& program) {
  return joined(program.variable_lower(), program.constraint_lower());
}
Eigen::VectorXd upper_bounds(const Transcription& program) {
  return joined(program.variable_upper(), program.constraint_upper());
}

std::shared_ptr<Transcription> transcribed(const Case& the_case, const Problem& problem) {
  return std::make_shared<Transcription>(problem, *make_element(the_case.method),
                                         make_tableau(the_case.tableau, the_case.stages), the_case.grid,
                                         openable(problem, the_case.varied));
}

}  // namespace

bool CaseBatch::takes(const Case& the_case, const SolverOptions& options) {
  const bool is_ours = the_case.solver == "interior_point" || the_case.solver == "auto";
  return is_ours && the_case.derivatives == "tape" && the_case.form == CostForm::bolza &&
         !family_of(the_case.method).is_condensed && options.most_seconds <= 0.0 && !options.verbose;
}

bool CaseBatch::share_program(const Case& a, const Case& b) {
  return program_problem(a) == program_problem(b) && a.varied == b.varied && a.method == b.method &&
         a.tableau == b.tableau && a.stages == b.stages && a.solver == b.solver && a.derivatives == b.derivatives &&
         a.form == b.form && a.tolerance == b.tolerance && a.intervals() == b.intervals() &&
         a.grid.relative_times() == b.grid.relative_times();
}

CaseBatch::CaseBatch(const Case& any, SolverOptions options)
    : options_(std::move(options)),
      problem_(program_problem(any)),
      program_(any.nominal ? transcribed(any, *problem_) : any.transcribe()),
      has_instances_(any.nominal != nullptr),
      usual_parameters_(program_->parameter_values()),
      usual_horizon_(program_->guessed_horizon()),
      usual_lower_(lower_bounds(*program_)),
      usual_upper_(upper_bounds(*program_)) {
  options_.tolerance = any.tolerance.value_or(options_.tolerance);
}

/// A program that keeps parameters open has the horizon of every instance; another one cannot.
bool CaseBatch::has_usual_bounds() const {
  const bool has_open = !program_->traced_problem().open_parameters().empty();
  if (!has_open && program_->guessed_horizon() != usual_horizon_) return false;
  const Eigen::VectorXd lower = lower_bounds(*program_);
  const Eigen::VectorXd upper = upper_bounds(*program_);
  const auto is_fixed = usual_lower_.array() == usual_upper_.array();
  return (is_fixed || (lower.array() == usual_lower_.array() && upper.array() == usual_upper_.array())).all();
}

void CaseBatch::give_values_of(const Case& the_case) {
  if (!has_instances_) return;
  program_->set_parameters(the_case.parameters);
  program_->set_initial_state(the_case.problem->initial_state());
  program_->set_final_state(the_case.problem->final_state());
}

bool CaseBatch::fill(BatchedCase& one) {
  try {
    give_values_of(*one.the_case);
    if (!has_usual_bounds()) return false;
    one.instance.start = sample(*program_, one.start.motion);
  } catch (const Error&) {  // it is then solved alone, and its row reports the error
    return false;
  }
  const Eigen::VectorXd& rows = program_->constraint_lower();
  one.instance.equality_values = rows.array().isFinite().select(rows, 0.0);  // values of inequalities are not read
  if (!program_->traced_problem().open_parameters().empty()) one.instance.parameters = one.the_case->parameters;
  return true;
}

void CaseBatch::solve(std::span<BatchedCase> cases) {
  std::vector<BatchedCase*> taken;
  for (BatchedCase& one : cases) {
    if (fill(one)) taken.push_back(&one);
  }
  if (has_instances_) program_->set_parameters(usual_parameters_);
  BatchOptions options;
  options.tolerance = options_.tolerance;
  options.most_iterations = options_.most_iterations;
  options.stop_requested = options_.stop_requested;
  if (has_instances_) options.set_parameters = parameters_of(*program_);
  const auto next = [&](std::size_t index, BatchInstance& instance) {
    if (index < taken.size()) instance = taken[index]->instance;
    return index < taken.size();
  };
  const auto take = [&](std::size_t index, const Solution& solution) { taken[index]->solution = solution; };
  try {
    solve_batch(*program_, lanes_of(*program_), sample(*program_, guessed_motion(*program_)), next, take, options);
  } catch (const Error&) {  // the program does not fit a batch; its cases are solved one by one
    is_refused_ = true;
    for (BatchedCase* const one : taken) one->solution.reset();
  }
}

SolvedCase CaseBatch::judged_case(const BatchedCase& one) {
  give_values_of(*one.the_case);
  SolvedCase solved{.the_case = *one.the_case, .program = program_, .solution = one.solution.value_or(Solution())};
  solved.start = one.instance.start;
  solved.tolerance = options_.tolerance;
  solved.is_timed = false;
  if (!has_instances_) {
    if (auto answer = answers_.find(solved)) {
      take_judgement(solved, one.start, std::move(answer));
      return solved;
    }
  }
  judge_case(solved, one.start, options_);
  return solved;
}

namespace {

/// The cases of these numbers with their starts; a case without a start reports this when it is solved alone.
std::vector<BatchedCase> started(const BatchWork& work, std::span<const std::size_t> numbers) {
  std::vector<BatchedCase> group;
  for (const std::size_t number : numbers) {
    const Case& the_case = work.cases[number];
    try {
      group.push_back({.number = number, .the_case = &the_case, .start = work.start(the_case)});
    } catch (const Error&) {
      continue;
    }
  }
  return group;
}

/// Null if the program cannot be made; the case reports the reason when it is solved alone.
std::unique_ptr<CaseBatch> batch_of(const Case& the_case, const SolverOptions& options) {
  try {
    return std::make_unique<CaseBatch>(the_case, options);
  } catch (const Error&) {
    return nullptr;
  }
}

void judge_and_keep(const BatchWork& work, CaseBatch& batch, const BatchedCase& one) {
  SolvedCase solved = batch.judged_case(one);
  const Status status = solved.solution.status;
  if (interrupt_requested() && status == Status::interrupted) return;                           // its judgement was
  if (solved.the_case.solver == "auto" && !is_solved(status) && !is_no_motion(status)) return;  // ipopt continues alone
  work.keep(solved, one.number);
}

void solve_cases_of_program(const BatchWork& work, std::span<const std::size_t> numbers) {
  constexpr std::size_t most_in_group = 2048;
  const std::unique_ptr<CaseBatch> batch = batch_of(work.cases[numbers.front()], work.options);
  if (!batch) return;
  for (; !numbers.empty() && !interrupt_requested();
       numbers = numbers.subspan(std::min(most_in_group, numbers.size()))) {
    std::vector<BatchedCase> group = started(work, numbers.first(std::min(most_in_group, numbers.size())));
    if (group.empty()) continue;
    work.show(fmt::format("{} and {} more", group.front().the_case->label(), group.size() - 1));
    batch->solve(group);
    if (batch->is_refused()) return;
    const bool was_interrupted = interrupt_requested();  // then unsolved cases may not have been solved to their end
    for (const BatchedCase& one : group) {
      if (one.solution && (!was_interrupted || is_solved(one.solution->status))) judge_and_keep(work, *batch, one);
    }
  }
}

}  // namespace

std::vector<CaseSpan> spans_of_programs(const std::vector<Case>& cases, const std::vector<CaseSpan>& problems,
                                        const std::vector<std::size_t>& groups, std::size_t least) {
  std::vector<CaseSpan> pieces;
  for (const CaseSpan& problem : problems) {
    const std::size_t before = pieces.size();
    CaseSpan piece = problem;
    std::size_t needed = problem.end;  // the first case in the group of any case after the border
    for (std::size_t border = problem.end; border-- > problem.first + 1;) {
      needed = std::min(needed, groups[border]);
      const bool is_long_enough = piece.end - border >= least && border - problem.first >= least;
      if (!is_long_enough || needed < border || CaseBatch::share_program(cases[border - 1], cases[border])) continue;
      pieces.push_back({border, piece.end});
      piece.end = border;
    }
    pieces.push_back(piece);
    std::reverse(pieces.begin() + static_cast<std::ptrdiff_t>(before), pieces.end());
  }
  return pieces;
}

void solve_in_batches(const BatchWork& work, const CaseSpan& span) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = span.first; i < span.end; ++i) {
    if (work.is_wanted[i] && CaseBatch::takes(work.cases[i], work.options)) numbers.push_back(i);
  }
  for (std::span<std::size_t> left(numbers); !left.empty() && !interrupt_requested();) {
    const Case& first = work.cases[left.front()];
    const auto others = std::ranges::stable_partition(
        left, [&](std::size_t i) { return CaseBatch::share_program(first, work.cases[i]); });
    const auto count = left.size() - others.size();
    solve_cases_of_program(work, left.first(count));
    left = left.subspan(count);
  }
}

}  // namespace dmocbench
