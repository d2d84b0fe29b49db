#include "bench/run/start_provider.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <random>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/run/described_tables.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/json_place.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/uniform_01.hpp"
#include "methods/diagnostics/accuracy.hpp"
#include "methods/judgement/polish.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

constexpr long long final_intervals = 144;
constexpr std::array guess_intervals{48LL, 96LL, 144LL};

/// The problem of a solve with its parameters, its scheme and grid; equal for solves with the same answer.
std::string identity_of(const std::string& problem, const std::string& settings, const std::string& method,
                        const std::string& tableau, int stages, std::size_t intervals) {
  return fmt::format("{} {} {} {} {} {}", problem, settings, method, tableau, stages, intervals);
}

/// The metadata in a file; null if it does not contain metadata.
nlohmann::ordered_json metadata_in(const std::filesystem::path& file) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return {};
  try {
    return json_or_null(read_file(file));
  } catch (const Error&) {
    return {};  // written by another program
  }
}

/// The identity of the solve that wrote a node file, if the metadata contain it; empty otherwise.
std::string origin_in(const nlohmann::ordered_json& metadata, const std::string& nodes) {
  try {
    if (!metadata.is_object() || !metadata.contains("motions")) return {};
    for (const auto& motion : metadata["motions"]) {
      if (motion.at("nodes") != nodes) continue;
      // The last iterate of a solve that failed may be continued by the same solve.
      if (!is_solved(status_named(motion.value("status", std::string(name_of(Status::solved)))))) return {};
      return identity_of(motion.at("problem"), motion.value("settings", std::string()), motion.at("method"),
                         motion.at("tableau"), motion.at("stages"), motion.at("intervals"));
    }
  } catch (const nlohmann::ordered_json::exception&) {  // these are not the metadata of a solve
  }
  return {};
}

/// The JSON files next to a node file; files whose name it begins with, as with its run's, come first.
std::vector<std::filesystem::path> metadata_beside(const std::filesystem::path& nodes_file) {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path folder = nodes_file.has_parent_path() ? nodes_file.parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::ranges::partition(files, [&](const std::filesystem::path& file) {
    return nodes_file.filename().string().starts_with(file.stem().string());
  });
  return files;
}

/// The identity of the solve that wrote a node file, according to the metadata next to it; empty if there are none.
/// Throws `Error` if they describe another content, for example because the file was cut short.
std::string origin_of(const std::filesystem::path& nodes_file, const MotionTexts& texts) {
  const std::string nodes = nodes_file.filename().string();
  for (const std::filesystem::path& file : metadata_beside(nodes_file)) {
    const nlohmann::ordered_json metadata = metadata_in(file);
    std::string origin = origin_in(metadata, nodes);
    if (origin.empty()) continue;
    try {
      const std::string source = file.filename().string();
      require_as_written(metadata, source, nodes, texts.nodes);
      if (!texts.stages.empty()) {
        require_as_written(metadata, source, stages_file_of(nodes_file).filename().string(), texts.stages);
      }
    } catch (const Error& error) {
      throw Error("{}; run it again, or give your own trajectory another name", error.what());
    }
    return origin;
  }
  return {};
}

/// The least order of the jumps of an answer (`accuracy`): one more than the order of the nodes, or of the stage
/// controls.
int order_of_jumps(const Tableau& tableau) {
  return std::min(tableau.order + 1, static_cast<int>(tableau.stages()) + 2);
}

/// True if the intervals of an answer, replayed alone, join better by 2^order on twice as many intervals (half an order
/// is granted to the asymptotics). The jumps of a spurious minimum of a coarse grid do not fall like this. Those near
/// the solver's tolerance fall no further.
bool do_jumps_fall(const Problem& problem, const Trajectory& coarse, const Trajectory& fine) {
  constexpr double solver_floor = 1e-8;
  const double before = accuracy(problem, coarse).relative_jump;
  const double after = accuracy(problem, fine).relative_jump;
  return after < solver_floor || after <= before * std::pow(2.0, 0.5 - order_of_jumps(fine.tableau));
}

/// The range of every q_i along a motion; 1 where it does not move.
Eigen::VectorXd ranges(const Motion& motion) {
  constexpr int samples = 64;
  Eigen::VectorXd lowest = motion.at(0.0).q;
  Eigen::VectorXd highest = lowest;
  for (int i = 1; i <= samples; ++i) {
    const Eigen::VectorXd q = motion.at(motion.horizon * i / samples).q;
    lowest = lowest.cwiseMin(q);
    highest = highest.cwiseMax(q);
  }
  const Eigen::VectorXd range = highest - lowest;
  return (range.array() > 0.0).select(range, 1.0);
}

}  // namespace

/// The search of one common start, within its time.
class StartProvider::Search {
 public:
  Search(const StartProvider& provider, const Case& the_case)
      : provider_(provider), case_(the_case), options_(provider.options_) {
    options_.stop_requested = [this] { return must_stop(); };
  }
  // The options refer to this object.
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;
  ~Search() = default;

  [[nodiscard]] FoundStart run() {
    std::vector<Candidate> candidates = solved_from_guess();
    std::ranges::sort(candidates, {}, [](const Candidate& candidate) { return candidate.trajectory.cost; });
    for (const long long intervals : {final_intervals, 2 * final_intervals}) {
      for (Candidate& candidate : candidates) {
        if (must_stop()) return tl::unexpected(reason());
        if (candidate.trajectory.intervals() < intervals && !refine(candidate)) continue;
        if (!is_motion(candidate.trajectory)) continue;
        Candidate finer = candidate;
        if (!refine(finer)) continue;
        Motion motion = smooth_motion(candidate.trajectory);
        // Where no answer keeps to its branch minima are dense; then any motion will do.
        const bool is_right_branch = intervals > final_intervals || is_on_branch(finer.trajectory, motion);
        if (is_right_branch && do_jumps_fall(*case_.problem, candidate.trajectory, finer.trajectory)) {
          return CommonStart{candidate.method, static_cast<std::size_t>(intervals), std::move(motion),
                             smooth_motion(finer.trajectory)};
        }
        candidate = std::move(finer);
      }
    }
    return tl::unexpected(reason());
  }

 private:
  struct Candidate {
    std::string method;
    Trajectory trajectory;
  };

  [[nodiscard]] bool is_motion(const Trajectory& trajectory) const {
    return accuracy(*case_.problem, trajectory).is_motion();
  }

  /// Solves it again on twice as many intervals; false, and the candidate as it was, if that fails.
  [[nodiscard]] bool refine(Candidate& candidate) {
    const long long intervals = 2 * static_cast<long long>(candidate.trajectory.intervals());
    auto finer = solve_on(candidate.method, intervals, smooth_motion(candidate.trajectory));
    if (!finer) return false;
    candidate.trajectory = *std::move(finer);
    return true;
  }

  [[nodiscard]] bool is_interrupted() const {
    return provider_.options_.stop_requested && provider_.options_.stop_requested();
  }

  /// Called between the iterations of all solves.
  [[nodiscard]] bool must_stop() {
    constexpr double seconds_of_silence = 5.0;
    const double seconds = seconds_since(begin_);
    if (!is_told_ && seconds > seconds_of_silence && provider_.on_long_search) {
      is_told_ = true;
      provider_.on_long_search(fmt::format("searching for the common start of {} for at most {:g} s (--start-seconds)",
                                           case_.problem->name(), provider_.rules_.most_seconds));
    }
    return is_interrupted() || seconds >= provider_.rules_.most_seconds;
  }

  [[nodiscard]] std::string reason() const {
    const std::string& name = case_.problem->name();
    if (seconds_since(begin_) >= provider_.rules_.most_seconds) {
      return fmt::format(
          "The solve started at the guess: no common start of {} was found within {:g} s; increase --start-seconds.",
          name, provider_.rules_.most_seconds);
    }
    return fmt::format(
        "The solve started at the guess: {} has no common start, because no method found a solution from the guess "
        "that follows the continuous dynamics on {} or {} intervals.",
        name, final_intervals, 2 * final_intervals);
  }

  [[nodiscard]] std::vector<Candidate> solved_from_guess() {
    std::vector<Candidate> candidates;
    const Motion guess = guessed_motion(*case_.problem);
    const TracedProblem traced(*case_.problem);
    for (const std::string& method : paper_families()) {
      if (!takes_constraints(*make_element(method), traced, make_tableau(case_.tableau, case_.stages))) continue;
      for (const long long intervals : guess_intervals) {
        if (must_stop()) return candidates;
        auto trajectory = solve_on(method, intervals, guess);
        if (trajectory && intervals != final_intervals) {
          trajectory = solve_on(method, final_intervals, smooth_motion(*trajectory));
        }
        if (trajectory) candidates.push_back({method, std::move(*trajectory)});
      }
    }
    return candidates;
  }

  [[nodiscard]] std::optional<Trajectory> solve_on(const std::string& method, long long intervals,
                                                   const Motion& start) {
    Case candidate{.problem = case_.problem, .method = method, .tableau = case_.tableau};
    candidate.stages = case_.stages;
    candidate.grid = Grid::uniform(intervals);
    std::unique_ptr<Transcription> program;
    try {
      const StopScope scope([this] { return must_stop(); }, 0.0);
      program = candidate.transcribe();
    } catch (const Stopped&) {
      return std::nullopt;
    }
    for (const char* solver : {"interior_point", "ipopt"}) {
      if (must_stop()) break;
      if (provider_.on_progress) {
        const double left = std::max(0.0, provider_.rules_.most_seconds - seconds_since(begin_));
        provider_.on_progress(fmt::format("{} {} {}: common start, {} on {} intervals by {}, at most {:.0f} s more",
                                          case_.problem->name(), case_.tableau, case_.stages, method, intervals, solver,
                                          left));
      }
      Solution solution = make_solver(solver, options_)->solve(*program, sample(*program, start));
      settle(*program, options_.tolerance, solution);
      if (is_solved(solution.status)) return read_trajectory(*program, solution.primal, solution.multipliers);
    }
    return std::nullopt;
  }

  const StartProvider& provider_;
  const Case& case_;
  SolverOptions options_;
  Clock::time_point begin_ = Clock::now();
  bool is_told_ = false;
};

StartProvider::StartProvider(Rules rules, SolverOptions options)
    : rules_(std::move(rules)), options_(std::move(options)) {
  options_.verbose = false;
  options_.tolerance = std::min(options_.tolerance, SolverOptions{}.tolerance);
  options_.most_iterations = std::min(options_.most_iterations, SolverOptions{}.most_iterations);
}

StartKind StartProvider::Rules::kind() const {
  if (start == "common") return StartKind::common;
  return start == "guess" ? StartKind::guess : StartKind::file;
}

void StartProvider::check(const std::vector<Case>& cases) {
  if (rules_.kind() != StartKind::file) return;
  for (const Case& the_case : cases) static_cast<void>(motion_in_file(*the_case.problem));
}

const Trajectory& StartProvider::motion_in_file(const Problem& problem) {
  if (const auto known = files_.find(problem.name()); known != files_.end()) return known->second;
  if (!texts_) {
    std::error_code none;  // a failed lookup counts as missing
    if (!std::filesystem::exists(rules_.start, none))
      throw Error("--start takes common, guess or an existing file, not {}", rules_.start);
    texts_ = read_motion_texts(rules_.start);
    origin_ = origin_of(rules_.start, *texts_);
  }
  return files_.emplace(problem.name(), motion_in_texts(problem, *texts_, rules_.start)).first->second;
}

Start StartProvider::start_for(const Case& the_case) {
  if (rules_.kind() == StartKind::file) return start_in_file(the_case);
  const bool from_guess = rules_.kind() == StartKind::guess;
  if (the_case.nominal && !from_guess) {
    Case nominal = the_case;
    nominal.problem = std::exchange(nominal.nominal, nullptr);
    return start_for(nominal);
  }
  Start start{guessed_motion(*the_case.problem)};
  if (from_guess && !rules_.reports_branch_from_guess) return start;
  const FoundStart& found = common_start(the_case);
  if (!found) {
    if (options_.stop_requested && options_.stop_requested()) throw Interrupted();
    start.note = found.error();
    return start;
  }
  const bool own = found->method == the_case.method && the_case.intervals() == found->intervals;
  if (!from_guess) start.motion = own ? found->finer : found->motion;
  if (rules_.reports_branch) start.branch = from_guess ? found->motion : start.motion;
  return start;
}

Start StartProvider::start_in_file(const Case& the_case) {
  const Trajectory& tables = motion_in_file(the_case.nominal ? *the_case.nominal : *the_case.problem);
  if (origin_ == identity_of(the_case.problem->name(), the_case.problem->settings(), the_case.method, the_case.tableau,
                             the_case.stages, the_case.intervals())) {
    throw NoStart(
        fmt::format("--start {} is already the solution of {}; counts and times from this start would be meaningless",
                    rules_.start, the_case.label()));
  }
  const Motion motion = smooth_motion(tables);
  Start start{motion, rules_.reports_branch ? std::optional(motion) : std::nullopt};
  if (rules_.takes_costates && tables.has_costates()) start.with_costates = tables;
  return start;
}

Trajectory StartProvider::solve(const Case& the_case) {
  const Start start = start_for(the_case);
  const SolvedCase solved = solve_case(the_case, start, *make_solver(the_case.solver, options_), options_.tolerance, 1);
  if (solved.trajectory && is_usable(solved)) return *solved.trajectory;
  if (options_.stop_requested && options_.stop_requested()) throw Interrupted();
  if (!is_solved(solved.solution.status)) {
    throw Error("{} has no usable solution ({}): {}", the_case.label(), name_of(solved.solution.status),
                solved.solution.message);
  }
  throw Error("{} is solved, but possibly on a different branch from the other methods: {}", the_case.label(),
              start.note.empty() ? "the solution is far from the common start." : start.note);
}

const StartProvider::FoundStart& StartProvider::common_start(const Case& the_case) {
  const Key key{the_case.problem->name(), the_case.tableau, the_case.stages};
  if (const auto known = common_.find(key); known != common_.end()) return known->second;
  return common_.emplace(key, Search(*this, the_case).run()).first->second;
}

Motion perturbed(const Motion& motion, double amplitude, std::uint64_t seed, std::uint64_t number,
                 const Eigen::VectorXd& control_scales) {
  constexpr Eigen::Index modes = 3;
  if (number == 0) return motion;
  std::seed_seq mixed{seed, number};
  std::mt19937_64 engine(mixed);
  const auto drawn = [&](const Eigen::VectorXd& sizes) {
    Eigen::MatrixXd amplitudes(sizes.size(), modes);
    for (Eigen::Index k = 0; k < modes; ++k) {
      for (Eigen::Index i = 0; i < sizes.size(); ++i) {
        amplitudes(i, k) = amplitude * sizes[i] * (2.0 * uniform_01(engine) - 1.0) / static_cast<double>(k + 1);
      }
    }
    return amplitudes;
  };
  const Eigen::MatrixXd of_motion = drawn(ranges(motion));  // first, so that controls do not change its curves
  return control_scales.size() == 0 ? bent(motion, of_motion) : bent(motion, of_motion, drawn(control_scales));
}

Eigen::VectorXd control_scales(const Problem& problem) {
  constexpr int samples = 64;
  const Eigen::Index m = problem.control_size();
  Eigen::MatrixXd guessed(m, samples + 1);
  for (int i = 0; i <= samples; ++i) guessed.col(i) = problem.guess(problem.horizon() * i / samples).u;
  const Bounds bounds = problem.bounds().u;
  Eigen::VectorXd scales(m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const double width = bounds.empty() ? unbounded : bounds.upper[j] - bounds.lower[j];
    const double range = guessed.row(j).maxCoeff() - guessed.row(j).minCoeff();
    scales[j] = std::isfinite(width) ? 0.5 * width : range > 0.0 ? range : guessed.row(j).cwiseAbs().maxCoeff();
  }
  return scales;
}

std::string varied_in_words(const Problem& problem) {
  const Eigen::VectorXd scales = control_scales(problem);
  const std::vector<std::string> names = problem.control_names();
  std::vector<std::string> varied;
  std::vector<std::string> left;
  for (Eigen::Index j = 0; j < scales.size(); ++j) {
    (scales[j] > 0.0 ? varied : left).push_back(names[static_cast<std::size_t>(j)]);
  }
  std::string words = "starts vary q and v";
  if (!varied.empty()) words += fmt::format(" and the controls {}", fmt::join(varied, ", "));
  if (!left.empty()) {
    words += fmt::format("; the controls {} do not vary, because neither bounds nor guess determine their size",
                         fmt::join(left, ", "));
  }
  return words;
}

Motion bulged(const Motion& motion, const Eigen::Vector2d& bulges) {
  const Eigen::VectorXd range = ranges(motion);
  Eigen::MatrixXd amplitudes = Eigen::MatrixXd::Zero(range.size(), 2);
  amplitudes(0, 0) = bulges[0] * range[0];
  if (range.size() > 1) {
    amplitudes(1, 0) = bulges[1] * range[1];
  } else {
    amplitudes(0, 1) = bulges[1] * range[0];
  }
  return bent(motion, amplitudes);
}

}  // namespace dmocbench
