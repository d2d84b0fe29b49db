#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bench/run/solve_case.hpp"

namespace dmocbench {

/// What may help after a failed solve.
enum class Remedy : std::uint8_t {
  none,
  more_time,        ///< or fewer intervals
  finite_formula,   ///< bounds and a guess that keep the coordinates away from a singularity of a formula
  radians,          ///< a coordinate looks like an angle in degrees
  other_units,      ///< the sizes of two coordinates are far apart
  longer_horizon,   ///< or wider bounds
  longer_phases,    ///< the same for the durations of phases
  solver_auto,      ///< the solver that tries several, for a program that this solver rejects
  several_solvers,  ///< the same, for a program that this solver does not solve
  common_start,     ///< a motion that other methods find first
  another_guess,    ///< or a motion near the wanted one
  finer_grid,       ///< chosen by an accuracy, for a solved motion whose replay ends elsewhere
  feedback,         ///< for one whose replay does so because the system amplifies errors
};

/// The next thing to try, and what it is about.
struct Advice {
  Remedy remedy = Remedy::none;  ///< what to try
  std::string coordinate = {};   ///< of `radians`; of `other_units` the largest; whose replay misses the end
  double size = 0.0;             ///< by which it changes; its size; of `longer_horizon` the horizon; share of its range
  std::string smallest = {};     ///< of `other_units`, the smallest coordinate
  double smallest_size = 0.0;    ///< and its size
};

/// The next thing to try after a failed solve, chosen from the properties of the problem and the solve: angles in
/// degrees, units, a longer horizon, another solver or start. `start` is the argument of --start. None for a case that
/// is solved, or that was stopped from outside.
[[nodiscard]] Advice next_to_try(const SolvedCase& solved, const std::string& start);

/// Radians, for a coordinate that is stated in them, by its unit or by a Lagrangian of period 2π, and changes by a
/// number that looks like an angle in degrees. Such a problem may be solved all the same. None if there is none.
[[nodiscard]] Advice doubt_about_units(const Problem& problem);

/// For a solved case whose replay misses the end of a coordinate by more than a tenth of its range: a finer grid where
/// the jumps of its intervals could add up to a tenth of that, feedback where they are less and so the system amplifies
/// errors. None where it does not, or was not replayed.
[[nodiscard]] Advice doubt_about_replay(const SolvedCase& solved, const std::optional<ReplayError>& replay);

/// One sentence that begins with "Try", with the options of programs; empty without advice.
[[nodiscard]] std::string in_words(const Advice& advice);

/// "more_time": the name of a remedy, for other languages.
[[nodiscard]] std::string_view name_of(Remedy remedy) noexcept;

/// "3e-05 m, 1e-06 rad, 2e-04 m/s": the largest error of the replayed end, by unit; without units the norm of all.
[[nodiscard]] std::string replay_in_words(const Problem& problem, const ReplayError& replay);

}  // namespace dmocbench
