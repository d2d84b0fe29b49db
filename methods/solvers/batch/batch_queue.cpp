#include "methods/solvers/batch/batch_queue.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/program/status.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/batch/batch_source.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"

namespace dmocbench::batch {

SharedBatch::SharedBatch(NonlinearProgram& program, BatchSource& source, const BatchOptions& options)
    : program_(program), source_(source), options_(options), limits_(nullptr, options.most_seconds) {}

void SharedBatch::begin_generation() noexcept {
  is_exhausted_ = false;
  guard([&] { has_ended_ = !source_.begin_generation(); });
  has_ended_ = has_ended_ || is_stopped_;
}

std::size_t SharedBatch::hand_out(std::span<Assignment> group) {
  std::size_t count = 0;
  {
    const std::lock_guard lock(handing_out_);
    while (count < group.size() && !is_exhausted_ && !is_stopped_) {
      group[count].index = handed_out_;
      is_exhausted_ = !source_.hand_out(group[count]);
      if (is_exhausted_) break;
      ++handed_out_;
      ++count;
    }
  }
  group = group.first(count);
  assert(!handing_out_.is_mine());
  for (Assignment& assignment : group) source_.search(assignment);
  const std::lock_guard lock(handing_out_);
  for (Assignment& assignment : group) source_.fill(assignment);
  return count;
}

double SharedBatch::seconds_of_a_scope() const {
  constexpr double moment = 1e-9;  // 0 would mean no limit
  return std::max(limits_.seconds_left(), moment);
}

void SharedBatch::take(std::span<const Answer> answers) {
  const std::lock_guard lock(taking_);
  for (const Answer& answer : answers) {
    if (is_solved(answer.solution.status)) ++summary_.solved;
    source_.take(answer.index, answer.solution);
  }
}

/// The result of `use` for the instance as a program of its own.
template <class Use>
auto SharedBatch::with_instance(const BatchInstance& instance, const Use& use) {
  if (options_.set_parameters) options_.set_parameters(instance.parameters);
  InstanceProgram program(program_, instance.start, instance.equality_values);
  return use(program);
}

Solution SharedBatch::solve_alone(const BatchInstance& instance) {
  SolverOptions single;
  single.tolerance = options_.tolerance;
  single.most_iterations = options_.most_iterations;
  single.stop_requested = options_.stop_requested;
  const StopScope scope(nullptr, seconds_of_a_scope());
  const InteriorPointSolver solver(std::move(single));
  const std::lock_guard lock(program_use_);
  ++summary_.solved_one_by_one;
  try {
    return with_instance(
        instance, [&](NonlinearProgram& alone) { return solver.solve(alone, instance.start, instance.multipliers); });
  } catch (const Error& error) {
    Solution refused;
    refused.status = Status::invalid_program;
    refused.message = error.what();
    return refused;
  }
}

void SharedBatch::confirm(const BatchInstance& instance, Solution& solution) {
  Scaling needed;
  bool may_be_saddle = false;
  {
    const std::lock_guard lock(program_use_);
    const StopScope scope([this] { return options_.stop_requested && options_.stop_requested(); },
                          seconds_of_a_scope());
    needed = with_instance(instance, [&](NonlinearProgram& alone) {
      Confirmation confirmation(alone);
      confirmation.judge(options_.tolerance, solution);
      may_be_saddle = confirmation.negative_curvature().has_value();
      return confirmation.scaling(options_.tolerance, instance.start, solution);
    });
  }
  if (needed.is_one() && !may_be_saddle) return;
  if (options_.falls_back) {
    solution = solve_alone(instance);
  } else if (needed.of_cost != 1.0) {
    refuse_small_cost(needed.of_cost, solution);
  }
}

void SharedBatch::count_round() {
  ++rounds_;
  if (limits_.seconds_left() < 0.0) is_stopped_ = true;
  if (!options_.stop_requested) return;
  const std::lock_guard lock(handing_out_);
  if (options_.stop_requested()) is_stopped_ = true;
}

void SharedBatch::add_seconds(const BatchSeconds& seconds) {
  const std::lock_guard lock(taking_);
  for (std::size_t i = 0; i < seconds.size(); ++i) summary_.seconds[i] += seconds[i];
}

void SharedBatch::fail(std::exception_ptr error) noexcept {
  const std::lock_guard lock(taking_);
  if (!error_) error_ = std::move(error);
  is_stopped_ = true;
}

BatchSummary SharedBatch::summary() {
  if (error_) std::rethrow_exception(error_);
  summary_.instances = handed_out_;
  summary_.rounds = rounds_;
  return summary_;
}

bool BatchQueue::fetch(Assignment& assignment) {
  while (true) {
    if (fetched_ == handed_out_) {
      fetched_ = handed_out_ = 0;  // also where this throws
      handed_out_ = batch_.hand_out(group_);
    }
    if (fetched_ == handed_out_) return false;
    std::swap(assignment, group_[fetched_++]);
    const Answer refused{assignment.index, check(assignment.instance)};
    if (refused.solution.status == Status::not_run) return true;
    batch_.take({&refused, 1});
  }
}

void BatchQueue::deliver(std::size_t index, Solution& solution) {
  answers_[answered_].index = index;
  std::swap(answers_[answered_].solution, solution);
  if (++answered_ == answers_.size()) deliver_answers();
}

void BatchQueue::deliver_answers() { batch_.take(std::span(answers_).first(std::exchange(answered_, 0))); }

void BatchQueue::solve_one_by_one(const Assignment& assignment, const Solution& so_far) {
  const bool falls_back = batch_.options().falls_back;
  const Answer answer{assignment.index, falls_back ? batch_.solve_alone(assignment.instance) : so_far};
  batch_.take({&answer, 1});
}

void BatchQueue::end_generation(const BatchSeconds& seconds) {
  batch_.add_seconds(seconds);
  deliver_answers();
  for (; fetched_ < handed_out_; ++fetched_) {  // where the batch was stopped
    Solution solution;
    solution.status = batch_.status_of_stop();
    solution.message = sentence_of(solution.status);
    solution.solver = "batch";
    solution.primal = group_[fetched_].instance.start;
    deliver(group_[fetched_].index, solution);
  }
  deliver_answers();
}

/// An answer for an instance that cannot be begun; `not_run` for all others.
Solution BatchQueue::check(const BatchInstance& instance) const {
  const NonlinearProgram& program = batch_.program();
  Solution refused;
  refused.solver = "batch";
  const auto require_size = [&](const char* what, const Eigen::VectorXd& vector, std::size_t wanted, bool may_lack) {
    if (static_cast<std::size_t>(vector.size()) == wanted || (may_lack && vector.size() == 0)) return;
    refused.status = Status::invalid_program;
    refused.message = fmt::format("The {} of the instance has {} entries, expected {}.", what, vector.size(), wanted);
  };
  require_size("start", instance.start, program.variable_count(), false);
  require_size("vector of constraint values", instance.equality_values, program.constraint_count(), true);
  require_size("vector of multipliers", instance.multipliers, program.constraint_count(), true);
  require_size("vector of parameters", instance.parameters, parameters_, true);
  if (refused.status != Status::not_run) return refused;
  for (const Eigen::VectorXd* vector :
       {&instance.start, &instance.equality_values, &instance.multipliers, &instance.parameters}) {
    if (vector->allFinite()) continue;
    refused.status = Status::evaluation_failed;
    refused.message = "The instance contains a number that is not finite.";
  }
  return refused;
}

}  // namespace dmocbench::batch
