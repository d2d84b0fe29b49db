#pragma once

#include <cstdint>
#include <string_view>

namespace dmocbench {

/// The outcome of a solve. Only `solved` and `control_not_determined` are answers that our own residual confirms.
enum class Status : std::uint8_t {
  not_run,                  ///< no solver has been called
  solved,                   ///< KKT residual and constraint violation are below the tolerance, or rounding (`StopRule`)
  acceptable,               ///< the solver stopped short of the tolerance, but within a hundred times of it
  infeasible,               ///< converged to a point of least constraint violation
  diverged,                 ///< iterates grew without bound
  step_failed,              ///< no further step could be computed (line search, restoration, too small a step)
  evaluation_failed,        ///< a formula gave NaN or infinity
  iteration_limit,          ///< the largest allowed number of iterations was reached
  time_limit,               ///< the allowed time was used up
  interrupted,              ///< stopped from outside
  too_large,                ///< the solver rejects a program of this size
  invalid_program,          ///< the solver rejects the program: too few degrees of freedom, a bad option or number
  out_of_memory,            ///< the solver could not allocate enough memory
  solver_error,             ///< the solver reported an internal error
  too_coarse,               ///< solved, but the answer is not a motion: its intervals do not join (`accuracy`)
  violates_between_stages,  ///< solved, but the motion leaves its bounds between stages (`violation_between_stages`)
  control_not_determined,   ///< solved, but a Newton step would move a control: cost and state hardly depend on it
  stationary,               ///< a stationary point next to which the constraints hold at a lower cost: not a minimum
  not_confirmed,            ///< the solver reports success, but our residual does not confirm it
};

/// The name that tables use: "solved", "iteration limit", ...
[[nodiscard]] std::string_view name_of(Status status) noexcept;

/// Its meaning, in one sentence.
[[nodiscard]] std::string_view sentence_of(Status status) noexcept;

/// The status with that name; `not_run` if there is none.
[[nodiscard]] Status status_named(std::string_view name) noexcept;

/// True for answers whose cost and state figures and claims may use: `solved` and `control_not_determined`. Of the
/// latter the control is not known as well.
[[nodiscard]] constexpr bool is_solved(Status status) noexcept {
  return status == Status::solved || status == Status::control_not_determined;
}

/// True for answers of the discrete program that are not motions: figures draw them hollow, and nothing is fitted to
/// them.
[[nodiscard]] constexpr bool is_no_motion(Status status) noexcept {
  return status == Status::too_coarse || status == Status::violates_between_stages;
}

}  // namespace dmocbench
