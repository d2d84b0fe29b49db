#include "methods/solvers/batch/solve_batch.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/kkt/intervals/lane_kkt.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/batch/batch_queue.hpp"
#include "methods/solvers/batch/instance_program.hpp"
#include "methods/solvers/batch/lane_run.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"

namespace dmocbench {

namespace batch {

namespace {

/// The queue of one batch, for all its threads.
class SharedBatchQueue final : public BatchQueue {
 private:
  /// What `use` makes of the instance as a program of its own.
  template <class Use>
  auto with_instance(const BatchInstance& instance, const Use& use) {
    if (options_.set_parameters) options_.set_parameters(instance.parameters);
    InstanceProgram program(program_, instance.start, instance.equality_values);
    return use(program);
  }

  Solution solve_alone(const BatchInstance& instance) {
    SolverOptions single;
    single.tolerance = options_.tolerance;
    single.most_iterations = options_.most_iterations;
    single.stop_requested = options_.stop_requested;
    const InteriorPointSolver solver(std::move(single));
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

 public:
  SharedBatchQueue(NonlinearProgram& program, std::size_t parameters, const NextInstance& next,
                   const TakeSolution& take, const BatchOptions& options)
      : program_(program), parameters_(parameters), next_(next), take_(take), options_(options) {}

  [[nodiscard]] bool fetch(Assignment& assignment) override {
    while (true) {
      {
        const std::lock_guard lock(fetching_);
        if (is_exhausted_ || is_stopped()) return false;
        assignment.index = fetched_;
        if (!next_(assignment.index, assignment.instance)) {
          is_exhausted_ = true;
          return false;
        }
        ++fetched_;
      }
      Solution refused = check(assignment.instance);
      if (refused.status == Status::not_run) return true;
      deliver(assignment.index, refused);
    }
  }

  void deliver(std::size_t index, const Solution& solution) override {
    const std::lock_guard lock(taking_);
    if (is_solved(solution.status)) ++summary_.solved;
    take_(index, solution);
  }

  void solve_one_by_one(const Assignment& assignment, const Solution& so_far) override {
    if (!options_.falls_back) return deliver(assignment.index, so_far);
    Solution solution;
    {
      const std::lock_guard lock(program_use_);
      ++summary_.solved_one_by_one;
      solution = solve_alone(assignment.instance);
    }
    deliver(assignment.index, solution);
  }

  void confirm(const Assignment& assignment, Solution& solution) override {
    const std::lock_guard lock(program_use_);
    with_instance(assignment.instance, [&](NonlinearProgram& instance) {
      dmocbench::confirm(instance, options_.tolerance, solution);
      return 0;
    });
  }

  [[nodiscard]] bool is_stopped() override { return is_stopped_; }
  void count_round() override {
    ++rounds_;
    if (!options_.stop_requested) return;
    const std::lock_guard lock(fetching_);
    if (options_.stop_requested()) is_stopped_ = true;
  }

  void add_seconds(const BatchSeconds& seconds) override {
    const std::lock_guard lock(taking_);
    for (std::size_t i = 0; i < seconds.size(); ++i) summary_.seconds[i] += seconds[i];
  }

  /// Ends the batch with what a thread has thrown; the first one counts.
  void fail(std::exception_ptr error) {
    const std::lock_guard lock(taking_);
    if (!error_) error_ = std::move(error);
    is_stopped_ = true;
  }

  /// Once all threads have ended.
  [[nodiscard]] BatchSummary summary() {
    if (error_) std::rethrow_exception(error_);
    summary_.instances = fetched_;
    summary_.rounds = rounds_;
    return summary_;
  }

 private:
  /// An answer for an instance that cannot be begun; `not_run` for all others.
  [[nodiscard]] Solution check(const BatchInstance& instance) const {
    Solution refused;
    refused.solver = "batch";
    const auto require_size = [&](const char* what, const Eigen::VectorXd& vector, std::size_t wanted, bool may_lack) {
      if (static_cast<std::size_t>(vector.size()) == wanted || (may_lack && vector.size() == 0)) return;
      refused.status = Status::invalid_program;
      refused.message = fmt::format("the {} of the instance has {} entries instead of {}", what, vector.size(), wanted);
    };
    require_size("start", instance.start, program_.variable_count(), false);
    require_size("vector of constraint values", instance.equality_values, program_.constraint_count(), true);
    require_size("vector of multipliers", instance.multipliers, program_.constraint_count(), true);
    require_size("vector of parameters", instance.parameters, parameters_, true);
    if (refused.status != Status::not_run) return refused;
    for (const Eigen::VectorXd* vector :
         {&instance.start, &instance.equality_values, &instance.multipliers, &instance.parameters}) {
      if (vector->allFinite()) continue;
      refused.status = Status::evaluation_failed;
      refused.message = "A number of the instance is not finite.";
    }
    return refused;
  }

  NonlinearProgram& program_;
  std::size_t parameters_;
  const NextInstance& next_;
  const TakeSolution& take_;
  const BatchOptions& options_;
  std::mutex fetching_;     // `next_`, `fetched_`
  std::mutex taking_;       // `take_`, `error_`
  std::mutex program_use_;  // `program_`
  std::size_t fetched_ = 0;
  bool is_exhausted_ = false;
  std::atomic<bool> is_stopped_{false};
  std::atomic<std::size_t> rounds_{0};
  BatchSummary summary_;
  std::exception_ptr error_;
};

/// The elimination of the lanes of every thread, all with the order that is chosen at the usual point.
std::unique_ptr<kkt::LaneKkt> make_kkt(NonlinearProgram& program, const Eigen::VectorXd& usual) {
  if (static_cast<std::size_t>(usual.size()) != program.variable_count()) {
    throw Error(fmt::format("the usual start of a batch has {} entries, the program {} variables", usual.size(),
                            program.variable_count()));
  }
  Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  program.jacobian(usual, jacobian);
  const Eigen::VectorXd hessian = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.hessian_structure().size()));
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(usual.size());
  const Eigen::VectorXd compliance = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.constraint_count()));
  auto made = kkt::LaneKkt::make(program, {hessian, jacobian, diagonal, compliance});
  if (!made) throw Error(fmt::format("a batch cannot take this program: {}", made.error()));
  return std::move(*made);
}

}  // namespace

}  // namespace batch

BatchSummary solve_batch(NonlinearProgram& program, const MakeLanes& make_lanes, const Eigen::VectorXd& usual,
                         const NextInstance& next, const TakeSolution& take, const BatchOptions& options) {
  SolverOptions single;
  single.tolerance = options.tolerance;
  single.most_iterations = options.most_iterations;
  single.validate();
  const std::size_t threads = options.threads > 0 ? options.threads : thread_count();
  std::vector<std::unique_ptr<LaneProgram>> lanes;
  lanes.reserve(threads);
  for (std::size_t i = 0; i < threads; ++i) lanes.push_back(make_lanes());
  batch::SharedBatchQueue queue(program, lanes.front()->parameter_count(), next, take, options);
  // All of them read the program, which belongs to one thread at a time as soon as threads work.
  std::vector<std::unique_ptr<batch::LaneRun>> runs;
  runs.reserve(lanes.size());
  for (std::unique_ptr<LaneProgram>& mine : lanes) {
    runs.push_back(
        std::make_unique<batch::LaneRun>(program, std::move(mine), batch::make_kkt(program, usual), options, queue));
  }
  const auto work = [&](batch::LaneRun& run) {
    try {
      run.run();
    } catch (...) {
      queue.fail(std::current_exception());
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back([&work, &run = *runs[i]] { work(run); });
    work(*runs.front());
  }
  return queue.summary();
}

}  // namespace dmocbench
