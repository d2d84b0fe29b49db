#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <tl/expected.hpp>

#include "bench/run/solve_case.hpp"
#include "methods/error.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/tables/motion_file.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

/// There is no motion that a case could start from; the sentence gives the reason.
class NoStart : public Error {
 public:
  /// With the sentence for the row, and its status.
  explicit NoStart(const std::string& sentence, Status of_row = Status::not_run) : Error(sentence), status(of_row) {}
  Status status;  ///< the status in the case's row
};

/// The kinds of starts of solves.
enum class StartKind : std::uint8_t {
  common,  ///< the common start of a problem and tableau
  guess,   ///< the problem's guess
  file,    ///< a motion in a file
};

/// Where solves start: the common start, the problem's guess or a file.
///
/// From the same guess the methods fall into different local minima, and coarse grids have spurious ones. The common
/// start of a problem and tableau is one motion for all methods and grids: each method solves from the guess at N = 48,
/// 96 and 144, each answer is solved again at 144 and at 288, and of those that are a motion the one with the lowest
/// objective is taken: on one branch on both grids, its intervals, replayed one by one (`accuracy`), join, and at 288
/// better than at 144, as the order predicts. If there is no such answer, the same is tried at 288 and 576, answers
/// cheapest at 144 first, and the finer answer may be on another branch. This judges unstable systems too, which a
/// replay of the whole horizon cannot. Each solve is one by `interior_point`, and where that fails one by Ipopt;
/// neither takes more iterations or seconds than a row's may.
class StartProvider {
 public:
  /// The options of the command line about starts.
  struct Rules {
    std::string start = "common";            ///< common, guess or the name of a node file
    double most_seconds = 30.0;              ///< of the search of one common start
    bool reports_branch = true;              ///< starts come with the motion whose branch a case should be on
    bool takes_costates = false;             ///< a file's costates come with its motion, where it has them
    bool reports_branch_from_guess = false;  ///< also starts at the guess, which takes the search of a common start

    /// The kind that `start` names.
    [[nodiscard]] StartKind kind() const;
  };
  /// `options` are for the solves that search for a common start.
  StartProvider(Rules rules, SolverOptions options);

  /// Reads the file, if a file is the start. Throws `Error` if it does not fit one of the problems.
  void check(const std::vector<Case>& cases);

  /// The motion to start this case from, and the motion whose branch it should be on. No case starts at its own answer:
  /// where the common start is the case's own method on the same grid, the answer on the finer grid serves; a file
  /// that is the case's own answer, with the same values of its parameters, is rejected: throws `NoStart`. Where no
  /// common start is found, in time or at all, it is the guess, and the note gives the reason; throws `Interrupted` if
  /// the search was interrupted.
  [[nodiscard]] Start start_for(const Case& the_case);

  /// The answer of a case from its start. Throws `Error` if it is not solved on the wanted branch, `Interrupted` if
  /// that is because a stop was requested.
  [[nodiscard]] Trajectory solve(const Case& the_case);

  /// Called before each solve on the way to a common start, with a description of it.
  std::function<void(const std::string&)> on_progress;
  /// Called once in a search that takes longer than five seconds, with a sentence.
  std::function<void(const std::string&)> on_long_search;

 private:
  struct CommonStart {
    std::string method;
    std::size_t intervals = 0;
    Motion motion;  // solved on them
    Motion finer;   // from there on twice as many
  };
  using FoundStart = tl::expected<CommonStart, std::string>;  // or the reason why it was not found
  using Key = std::tuple<std::string, std::string, int>;
  class Search;
  [[nodiscard]] const FoundStart& common_start(const Case& the_case);
  [[nodiscard]] const Trajectory& motion_in_file(const Problem& problem);
  [[nodiscard]] Start start_in_file(const Case& the_case);

  Rules rules_;
  SolverOptions options_;
  std::map<Key, FoundStart> common_;
  std::optional<MotionTexts> texts_;         // of the file
  std::map<std::string, Trajectory> files_;  // the file's motion, by the problem it was read for
  std::string origin_;  // which solve wrote the file: problem, parameters, scheme, grid; empty if unknown
};

/// A motion with smooth random curves added: to every q_i a sum of three sines that vanish at both ends, their
/// amplitudes drawn evenly between -a and a times the range of this q_i along the motion (1 if the range is 0) and
/// falling as 1/k, with their derivatives added to the velocity. To every control u_j are added a constant and two
/// cosines, in the same way between -a and a times its entry of `control_scales`; without entries the control stays.
/// The same `seed` and `number` give the same curves on every machine; number 0 is the motion itself.
[[nodiscard]] Motion perturbed(const Motion& motion, double amplitude, std::uint64_t seed, std::uint64_t number,
                               const Eigen::VectorXd& control_scales = {});

/// The size of every control of a problem: half the distance of its bounds, or where one of them is missing its range
/// along the guess, or its largest magnitude there; 0 if all of these are missing.
[[nodiscard]] Eigen::VectorXd control_scales(const Problem& problem);

/// The quantities that `perturbed` varies with these scales: "q, v and u", "q and v, not u: ...".
[[nodiscard]] std::string varied_in_words(const Problem& problem);

/// A motion with two curves added, which vanish at both ends: a_1 sin(πt/T) to q_1 and a_2 sin(πt/T) to q_2, or
/// a_2 sin(2πt/T) to q_1 where there is no q_2, in units of the range of that coordinate as in `perturbed`, with their
/// derivatives added to the velocity. The control stays.
[[nodiscard]] Motion bulged(const Motion& motion, const Eigen::Vector2d& bulges);

}  // namespace dmocbench
