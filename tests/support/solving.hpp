#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/judgement/polish.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/motions/grid.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench::tests {

/// A family of elements with a tableau.
struct Scheme {
  std::string method;
  int stages = 1;
  std::string family = "gauss";
  [[nodiscard]] std::string label() const { return method + "_" + family + std::to_string(stages); }
  [[nodiscard]] Tableau tableau() const { return make_tableau(family, stages); }
};

/// Names a test after the label of its parameter.
inline constexpr auto by_label = [](const auto& instance) { return instance.param.label(); };

/// Every family of elements with every tableau of one of the families of tableaus and up to `most_stages` stages.
std::vector<Scheme> schemes_of(const std::vector<std::string>& families, int most_stages);

/// Gauss and Lobatto, each stage with a control of its own.
std::vector<Scheme> all_schemes(int most_stages = 3);

/// A scheme and the solver that is asked.
struct Way {
  Scheme scheme;
  std::string solver;
  [[nodiscard]] std::string label() const { return scheme.label() + "_" + solver; }
};

/// All schemes by all of these solvers.
std::vector<Way> ways_by(const std::vector<std::string>& solvers);

/// Lobatto with one control at each node that two intervals share.
std::vector<Scheme> schemes_with_shared_controls(int most_stages = 3);

/// Whether a method has the holonomic constraints of a problem with its tableau; true of problems without.
bool takes_constraints(const Problem& problem, const Scheme& scheme);

std::unique_ptr<Transcription> transcribe(const Problem& problem, const Scheme& scheme, const Grid& grid);

/// A transcription with its solution; the transcription lives on because rows and costates are asked of it.
struct Solved {
  std::unique_ptr<Transcription> transcription;
  Solution solution;
  Trajectory trajectory;
};

/// Solves by Ipopt from a motion; a solve that fails fails the test.
Solved solve(const Problem& problem, const std::string& method, const Tableau& tableau, const Grid& grid,
             const Motion& start, double tolerance = 1e-10, CostForm form = CostForm::bolza);
Solved solve(const Problem& problem, const Scheme& scheme, const Grid& grid, const Motion& start,
             double tolerance = 1e-10, CostForm form = CostForm::bolza);

/// One motion from which all methods and grids start, so that they end on the same branch: DMOC's answer on 96
/// intervals. Solved once per problem.
const Motion& common_start(const Problem& problem);

/// A grid graded smoothly towards the start: τ(x) = x + ¼ x (x - 1), widths vary by a factor of 5/3.
Grid graded_grid(Eigen::Index intervals);

/// Largest magnitude of rows minus their bounds: the residual of a program whose rows are equalities.
double row_residual(Transcription& transcription, const Eigen::VectorXd& x);

/// The jacobian of the rows by the free variables, dense.
Eigen::MatrixXd free_columns(Transcription& program, const Eigen::VectorXd& x);

/// Sixteen even intervals and one between them that is a ten-millionth of the horizon.
inline Grid grid_with_a_narrow_interval() {
  Eigen::VectorXd nodes(18);
  nodes.head(9) = Eigen::VectorXd::LinSpaced(9, 0.0, 0.5);
  nodes.tail(9) = Eigen::VectorXd::LinSpaced(9, 0.5, 1.0);
  nodes[9] += 1e-7;
  return Grid::from_nodes(nodes);
}

/// A program with its answer.
struct Answer {
  std::unique_ptr<Transcription> program;
  Solution solution;
  Trajectory motion;
};

/// Solves to a tolerance and then to rounding; the test fails where the answer is not confirmed.
inline Answer confirmed(const Problem& problem, const Scheme& scheme, Eigen::Index intervals, const Motion& start,
                        double tolerance, const std::string& solver = "interior_point") {
  Answer answer{transcribe(problem, scheme, Grid::uniform(intervals)), {}, {}};
  SolverOptions options;
  options.tolerance = tolerance;
  answer.solution = make_solver(solver, options)->solve(*answer.program, sample(*answer.program, start));
  settle(*answer.program, options.tolerance, answer.solution);
  polish(*answer.program, answer.solution);
  EXPECT_TRUE(is_solved(answer.solution.status))
      << problem.name() << ", " << scheme.label() << ", N = " << intervals << ": " << answer.solution.message;
  answer.motion = read_trajectory(*answer.program, answer.solution.primal, answer.solution.multipliers);
  return answer;
}

}  // namespace dmocbench::tests
