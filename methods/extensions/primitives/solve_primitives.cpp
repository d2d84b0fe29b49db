#include "methods/extensions/primitives/solve_primitives.hpp"

#include <map>
#include <optional>
#include <utility>

#include "methods/error.hpp"
#include "methods/solvers/batch/solve_batch.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/lane_transcription.hpp"
#include "methods/transcription/motions/grid.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

namespace {

/// The cubic polynomial between two states, T apart, with a constant control.
Motion cubic_between(const BoundaryState& first, const BoundaryState& last, double horizon, const Eigen::VectorXd& u) {
  const Eigen::VectorXd chord = (last.q - first.q) / horizon;
  return {[=](double t) {
            const double s = t / horizon;
            const Eigen::VectorXd excess_first = first.v - chord;
            const Eigen::VectorXd excess_last = last.v - chord;
            const Eigen::VectorXd q =
                first.q + t * chord + t * (1.0 - s) * ((1.0 - s) * excess_first - s * excess_last);
            const Eigen::VectorXd v =
                chord + (1.0 - s) * (1.0 - 3.0 * s) * excess_first + s * (3.0 * s - 2.0) * excess_last;
            return MotionPoint{q, v, u};
          },
          horizon};
}

/// All requests of one duration: one program.
class PrimitiveBatch {
 public:
  PrimitiveBatch(const Problem& problem, const PrimitiveLibrary& library, int duration, const PrimitiveOptions& options)
      : library_(library),
        options_(options),
        start_control_(options.start_control.size() > 0 ? options.start_control : problem.guess(0.0).u),
        horizon_(library.step * duration),
        program_(problem, *make_element("dmoc"), gauss_tableau(1),
                 Grid::uniform(static_cast<long long>(duration) * library.intervals_per_step)) {
    require_primitives(program_);
    program_.set_horizon(horizon_);
    usual_ = sample(program_, guessed_motion(problem));
  }

  void solve(const std::vector<const PrimitiveRequest*>& requests,
             const std::vector<std::optional<Primitive>*>& results) {
    std::vector<BatchInstance> instances;
    instances.reserve(requests.size());
    for (const PrimitiveRequest* request : requests) instances.push_back(instance_of(*request));
    std::vector<Eigen::VectorXd> answers(requests.size());
    const auto next = [&](std::size_t index, BatchInstance& instance) {
      if (index < instances.size()) instance = instances[index];
      return index < instances.size();
    };
    const auto take = [&](std::size_t index, const Solution& solution) {
      if (is_solved(solution.status)) answers[index] = solution.primal;
    };
    solve_batch(program_, lanes_of(program_), usual_, next, take,
                {.tolerance = options_.tolerance,
                 .most_iterations = options_.most_iterations,
                 .falls_back = false,
                 .stop_requested = options_.stop_requested});
    for (std::size_t i = 0; i < requests.size(); ++i) {
      if (answers[i].size() > 0) *results[i] = primitive_of(*requests[i], answers[i]);
    }
  }

 private:
  [[nodiscard]] BatchInstance instance_of(const PrimitiveRequest& request) {
    const BoundaryState& first = library_.states[request.first];
    const BoundaryState last = request.displacement.state(library_.states[request.last]);
    program_.set_initial_state(first);
    program_.set_final_state(last);
    const Motion start = request.start.at ? request.start : cubic_between(first, last, horizon_, start_control_);
    const Eigen::VectorXd& rows = program_.constraint_lower();
    BatchInstance instance;
    instance.start = sample(program_, start);
    instance.equality_values = rows.array().isFinite().select(rows, 0.0);  // values of inequalities are not read
    return instance;
  }

  [[nodiscard]] Primitive primitive_of(const PrimitiveRequest& request, const Eigen::VectorXd& answer) {
    Trajectory motion = read_trajectory(program_, answer, {});
    return {.first = request.first,
            .last = request.last,
            .displacement = request.displacement,
            .duration = request.duration,
            .cost = motion.cost,
            .q = std::move(motion.q),
            .v = std::move(motion.v),
            .u = std::move(motion.stage_u)};
  }

  const PrimitiveLibrary& library_;
  const PrimitiveOptions& options_;
  Eigen::VectorXd start_control_;
  double horizon_;
  Transcription program_;
  Eigen::VectorXd usual_;
};

void require_possible(const PrimitiveRequest& request, const PrimitiveLibrary& library) {
  if (request.first < library.states.size() && request.last < library.states.size() && request.duration >= 1) return;
  throw Error("a primitive from state {} to state {} in {} time steps does not belong to a library with {} states",
              request.first, request.last, request.duration, library.states.size());
}

}  // namespace

void require_primitives(const Transcription& program) {
  const ProblemBounds bounds = program.problem().bounds();
  const TracedProblem& traced = program.traced_problem();
  if (bounds.first.all_fixed() && bounds.last.all_fixed() && !bounds.horizon.is_free() && !program.end_functions() &&
      traced.integral_count() == 0 && traced.unknown_count() == 0 && traced.first_order_size() == 0 &&
      program.functions().multipliers == 0 && bounds.interior.empty()) {
    return;
  }
  throw Error(
      "{} has no primitives: both ends and the horizon must be fixed, and a final cost, boundary "
      "conditions, integral constraints, unknown parameters, first-order states, constraints g(q) = 0 and "
      "bounds between the ends are not supported",
      program.problem().name());
}

void solve_primitives(const Problem& problem, const std::vector<PrimitiveRequest>& requests, PrimitiveLibrary& library,
                      const PrimitiveOptions& options) {
  std::vector<std::optional<Primitive>> results(requests.size());
  std::map<int, std::vector<std::size_t>> by_duration;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    require_possible(requests[i], library);
    by_duration[requests[i].duration].push_back(i);
  }
  for (const auto& [duration, numbers] : by_duration) {
    std::vector<const PrimitiveRequest*> asked;
    std::vector<std::optional<Primitive>*> answers;
    for (const std::size_t number : numbers) {
      asked.push_back(&requests[number]);
      answers.push_back(&results[number]);
    }
    PrimitiveBatch(problem, library, duration, options).solve(asked, answers);
  }
  for (std::optional<Primitive>& result : results) {
    if (result) library.primitives.push_back(std::move(*result));
  }
}

}  // namespace dmocbench
