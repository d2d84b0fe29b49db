#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "methods/solvers/batch/batch_source.hpp"
#include "methods/solvers/batch/solve_batch.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "methods/transcription/lane_transcription.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench::batch {

/// A program and what its instances are made of.
struct Case {
  Case(const std::string& name, const std::string& method, int stages, std::size_t intervals,
       const std::string& parameter = "", double value = 0.0)
      : problem(make_problem(name)) {
    if (!parameter.empty()) problem->set_parameter(parameter, value);
    program = std::make_unique<Transcription>(*problem, *make_element(method), make_tableau("gauss", stages),
                                              Grid::uniform(static_cast<long long>(intervals)));
    start = sample(*program, guessed_motion(*problem));
  }

  /// Instances whose ends are up to `share` away from those of the problem.
  [[nodiscard]] std::vector<BatchInstance> instances(std::size_t count, double share) const {
    tests::RandomPoints random;
    ClampedEnds ends(*program);
    const BoundaryState first = problem->initial_state();
    const BoundaryState last = problem->final_state();
    const auto moved = [&](BoundaryState end) {
      for (Eigen::Index i = 0; i < end.q.size(); ++i) {
        const double size = end.q[i] != 0.0 ? std::abs(end.q[i]) : std::abs(last.q[i] - first.q[i]);
        end.q[i] += random.number(-share, share) * size;
      }
      return end;
    };
    std::vector<BatchInstance> instances(count);
    for (BatchInstance& instance : instances) {
      instance.start = start;
      instance.equality_values = program->constraint_lower();
      const BoundaryState from = moved(first);
      ends.write(from, moved(last), instance.start, instance.equality_values);
    }
    return instances;
  }

  [[nodiscard]] std::vector<Solution> solve(const std::vector<BatchInstance>& instances,
                                            const BatchOptions& options = {}) {
    std::vector<Solution> solutions(instances.size());
    summary = solve_batch(
        *program, lanes_of(*program), start,
        [&](std::size_t index, BatchInstance& instance) {
          if (index == instances.size()) return false;
          instance = instances[index];
          return true;
        },
        [&](std::size_t index, const Solution& solution) { solutions[index] = solution; }, options);
    return solutions;
  }

  [[nodiscard]] Solution solve_alone(const BatchInstance& instance) const {
    InstanceProgram alone(*program, instance.start, instance.equality_values);
    return InteriorPointSolver().solve(alone, instance.start, instance.multipliers);
  }

  void expect_answers_of_single_solves(std::size_t count, double share) {
    const std::vector<BatchInstance> all = instances(count, share);
    const std::vector<Solution> solutions = solve(all);
    EXPECT_LE(summary.solved_one_by_one, count / 4);
    for (std::size_t i = 0; i < count; ++i) {
      const Solution alone = solve_alone(all[i]);
      EXPECT_EQ(solutions[i].status, alone.status) << i;
      EXPECT_NEAR(solutions[i].objective, alone.objective, 1e-10 * std::abs(alone.objective)) << i;
    }
  }

  std::unique_ptr<Problem> problem;
  std::unique_ptr<Transcription> program;
  Eigen::VectorXd start;
  BatchSummary summary;
};

}  // namespace dmocbench::batch
