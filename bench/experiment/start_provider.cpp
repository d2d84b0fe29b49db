#include "bench/experiment/start_provider.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiment/motion_file.hpp"
#include "bench/experiment/result_file.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/error.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

constexpr long long final_intervals = 144;
constexpr std::array guess_intervals{48LL, 96LL, 144LL};

/// Solves one method on a uniform grid; none if it does not converge.
std::optional<Trajectory> solve(const Case& base, const std::string& method, long long intervals, const Motion& start,
                                const SolverOptions& options) {
  Transcription transcription(*base.problem, *make_element(method), make_tableau(base.tableau, base.stages),
                              Grid::uniform(intervals));
  const Solution solution = make_solver("ipopt", options)->solve(transcription, sample(transcription, start));
  if (!is_solved(solution.status)) return std::nullopt;
  return read_trajectory(transcription, solution.primal, solution.multipliers);
}

/// A replay that leaves the set where the equations make sense has no error to speak of: infinity.
double replayed(const Problem& problem, const Trajectory& trajectory) {
  try {
    return replay_error(problem, trajectory).norm();
  } catch (const Error&) {
    return std::numeric_limits<double>::infinity();
  }
}

/// A true motion's replay error falls by 2^order when the grid is halved (half an order is granted to the asymptotics);
/// that of a spurious minimum of a coarse grid does not. Errors near the solver's tolerance fall no further.
bool falls_as_predicted(double coarse, double fine, int order) {
  constexpr double solver_floor = 1e-8;
  return fine < solver_floor || fine <= coarse * std::pow(2.0, 0.5 - order);
}

/// The method that a node file is the answer of and on which grid, as the metadata beside it tells; none if it does
/// not.
bool is_own_answer(const std::filesystem::path& nodes_file, const Case& solved_case) {
  const std::string name = nodes_file.filename().string();
  for (const auto& entry : std::filesystem::directory_iterator(
           nodes_file.has_parent_path() ? nodes_file.parent_path() : std::filesystem::path("."))) {
    if (entry.path().extension() != ".json") continue;
    const auto metadata = nlohmann::json::parse(read_file(entry.path()), nullptr, false);
    if (!metadata.is_object() || !metadata.contains("motions")) continue;
    for (const auto& motion : metadata["motions"]) {
      if (motion.value("nodes", "") != name) continue;
      return motion.value("method", "") == solved_case.method && motion.value("tableau", "") == solved_case.tableau &&
             motion.value("stages", 0) == solved_case.stages &&
             motion.value("intervals", 0LL) == static_cast<long long>(solved_case.intervals());
    }
  }
  return false;
}

}  // namespace

StartProvider::StartProvider(std::string kind, SolverOptions options)
    : kind_(std::move(kind)), options_(std::move(options)) {
  options_.verbose = false;
  options_.passed_on.clear();  // the start must not depend on how a row is solved
  options_.tolerance = std::min(options_.tolerance, SolverOptions{}.tolerance);
  options_.most_iterations = SolverOptions{}.most_iterations;
}

void StartProvider::check(const std::vector<Case>& cases) const {
  if (kind_ == "common" || kind_ == "guess") return;
  const Problem* checked = nullptr;
  for (const Case& what : cases) {
    if (what.problem.get() != checked) static_cast<void>(read_motion(*what.problem, kind_));
    checked = what.problem.get();
  }
}

Motion StartProvider::motion_for(const Case& solved_case) {
  if (kind_ == "guess") return guessed_motion(*solved_case.problem);
  if (kind_ != "common") {
    if (is_own_answer(kind_, solved_case)) {
      throw NoStart(fmt::format("--start {} is itself the answer of {}; counts and times from there would say nothing",
                                kind_, solved_case.label()));
    }
    return read_motion(*solved_case.problem, kind_);
  }
  const CommonStart& start = common_start(solved_case);
  const bool own = start.method == solved_case.method && solved_case.intervals() == final_intervals;
  return own ? start.finer : start.motion;
}

std::optional<Motion> StartProvider::branch_for(const Case& solved_case) {
  if (kind_ != "guess") return motion_for(solved_case);
  try {
    return common_start(solved_case).motion;
  } catch (const NoStart&) {
    return std::nullopt;
  }
}

const StartProvider::CommonStart& StartProvider::common_start(const Case& solved_case) {
  const Key key{solved_case.problem->name(), solved_case.tableau, solved_case.stages};
  const auto found = common_.find(key);
  if (found != common_.end()) return found->second;
  if (const auto none = without_.find(key); none != without_.end()) throw NoStart(none->second);
  try {
    return common_.emplace(key, find_common_start(solved_case)).first->second;
  } catch (const NoStart& reason) {
    without_.emplace(key, reason.what());  // to look again would take as long and find as little
    throw;
  }
}

StartProvider::CommonStart StartProvider::find_common_start(const Case& solved_case) const {
  struct Candidate {
    std::string method;
    Trajectory trajectory;
  };
  const Problem& problem = *solved_case.problem;
  const Motion guess = guessed_motion(problem);
  const auto stopped = [&] { return options_.stop_requested && options_.stop_requested(); };
  std::vector<Candidate> candidates;
  for (const std::string& method : element_names()) {
    for (const long long intervals : guess_intervals) {
      if (stopped()) throw NoStart("interrupted");
      if (on_progress) {
        on_progress(fmt::format("{} {} {}: common start, {} on {} intervals", problem.name(), solved_case.tableau,
                                solved_case.stages, method, intervals));
      }
      auto trajectory = solve(solved_case, method, intervals, guess, options_);
      if (trajectory && intervals != final_intervals) {
        trajectory = solve(solved_case, method, final_intervals, smooth_motion(*trajectory), options_);
      }
      if (trajectory) candidates.push_back({method, std::move(*trajectory)});
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.trajectory.cost < b.trajectory.cost; });
  for (const Candidate& candidate : candidates) {
    if (stopped()) throw NoStart("interrupted");
    const auto finer =
        solve(solved_case, candidate.method, 2 * final_intervals, smooth_motion(candidate.trajectory), options_);
    if (!finer) continue;
    if (falls_as_predicted(replayed(problem, candidate.trajectory), replayed(problem, *finer),
                           candidate.trajectory.tableau.order)) {
      return {candidate.method, smooth_motion(candidate.trajectory), smooth_motion(*finer)};
    }
  }
  throw NoStart(
      fmt::format("{} has no common start: from its guess no method finds a motion on {} intervals that a replay "
                  "confirms; try --start guess, or a file written by solve",
                  problem.name(), final_intervals));
}

}  // namespace dmocbench
