#include "methods/program/status.hpp"

#include <algorithm>
#include <array>

namespace dmocbench {

namespace {

struct Entry {
  Status status;
  std::string_view name;
  std::string_view sentence;
};

constexpr auto entries = std::to_array<Entry>({
    {Status::not_run, "not run", "No solver has been called."},
    {Status::solved, "solved",
     "The KKT residual and the constraint violation are below the tolerance, or below round-off where it is larger."},
    {Status::acceptable, "acceptable",
     "The solver did not reach the tolerance, but its residual is at most a hundred times the tolerance."},
    {Status::infeasible, "no trajectory found",
     "No trajectory was found: the last point is a local minimum of the constraint violation, and descent from other "
     "points did not satisfy the constraints either. This does not prove that the problem is infeasible."},
    {Status::diverged, "diverged", "The iterates grew without bound."},
    {Status::step_failed, "step failed", "The solver found no step that improves the iterate."},
    {Status::evaluation_failed, "evaluation failed", "A formula evaluated to NaN or infinity."},
    {Status::iteration_limit, "iteration limit", "The iteration limit was reached."},
    {Status::time_limit, "time limit", "The time limit was reached."},
    {Status::interrupted, "interrupted", "The solve was interrupted."},
    {Status::too_large, "too large", "The solver rejects a program of this size."},
    {Status::invalid_program, "invalid program", "The solver rejects the program or one of its options."},
    {Status::out_of_memory, "out of memory", "The solver ran out of memory."},
    {Status::solver_error, "solver error", "The solver reported an internal error."},
    {Status::too_coarse, "too coarse",
     "The discrete program is solved, but the grid is too coarse to follow the continuous dynamics; use more "
     "intervals."},
    {Status::violates_between_stages, "violates between stages",
     "The discrete program is solved, but its trajectory violates a bound or path constraint between the stages."},
    {Status::control_not_determined, "solved, control not determined",
     "The cost and the state are confirmed. They hardly depend on the control, which is therefore not determined."},
    {Status::stationary, "stationary, not a minimum",
     "The solution is a stationary point of the program, but not a minimum."},
    {Status::not_confirmed, "not confirmed",
     "The solver reports success, but the residual recomputed from exact derivatives does not confirm it."},
});

const Entry& entry_of(Status status) { return *std::ranges::find(entries, status, &Entry::status); }

}  // namespace

std::string_view name_of(Status status) noexcept { return entry_of(status).name; }

std::string_view sentence_of(Status status) noexcept { return entry_of(status).sentence; }

Status status_named(std::string_view name) noexcept {
  const auto* const found = std::ranges::find(entries, name, &Entry::name);
  return found == entries.end() ? Status::not_run : found->status;
}

}  // namespace dmocbench
