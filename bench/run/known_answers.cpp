#include "bench/run/known_answers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/judgement/confirm.hpp"
#include "methods/judgement/newton_correction.hpp"
#include "methods/judgement/polish.hpp"
#include "methods/program/status.hpp"

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

/// The optimum that Newton steps from a rounded answer lead to, judged; null if they lead to none.
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

}  // namespace dmocbench
