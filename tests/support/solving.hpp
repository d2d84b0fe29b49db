#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/solvers/solver.hpp"
#include "methods/transcription/interpolation.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench::tests {

/// A family of elements with a tableau.
struct Scheme {
  std::string method;
  int stages = 1;
  std::string family = "gauss";
  [[nodiscard]] std::string label() const { return method + " " + family + " s=" + std::to_string(stages); }
  [[nodiscard]] Tableau tableau() const { return make_tableau(family, stages); }
};

/// Every family of elements with every tableau of one of the families of tableaus and up to `most_stages` stages.
inline std::vector<Scheme> schemes_of(const std::vector<std::string>& families, int most_stages) {
  std::vector<Scheme> schemes;
  for (const std::string& method : element_names()) {
    for (const std::string& family : families) {
      for (const int s : tableau_stages(family)) {
        if (s <= most_stages) schemes.push_back({method, s, family});
      }
    }
  }
  return schemes;
}

/// Gauss and Lobatto, each stage with a control of its own.
inline std::vector<Scheme> all_schemes(int most_stages = 3) { return schemes_of({"gauss", "lobatto"}, most_stages); }

/// Lobatto with one control at each node that two intervals share.
inline std::vector<Scheme> schemes_with_shared_controls(int most_stages = 3) {
  return schemes_of({"lobatto_shared"}, most_stages);
}

inline std::unique_ptr<Transcription> transcribe(const Problem& problem, const Scheme& scheme, const Grid& grid) {
  return std::make_unique<Transcription>(problem, *make_element(scheme.method), scheme.tableau(), grid);
}

/// A transcription with its solution; the transcription lives on because rows and costates are asked of it.
struct Solved {
  std::unique_ptr<Transcription> transcription;
  Solution solution;
  Trajectory trajectory;
};

/// Solves by Ipopt from a motion; a solve that fails fails the test.
inline Solved solve(const Problem& problem, const std::string& method, const Tableau& tableau, const Grid& grid,
                    const Motion& start, double tolerance = 1e-10, CostForm form = CostForm::bolza) {
  Solved solved;
  solved.transcription = std::make_unique<Transcription>(problem, *make_element(method), tableau, grid, "tape", form);
  SolverOptions options;
  options.tolerance = tolerance;
  solved.solution = make_solver("ipopt", options)->solve(*solved.transcription, sample(*solved.transcription, start));
  EXPECT_EQ(solved.solution.status, Status::solved)
      << problem.name() << ", " << method << " " << tableau.family << " " << tableau.stages()
      << ", N = " << grid.intervals() << ": " << solved.solution.message;
  solved.trajectory = read_trajectory(*solved.transcription, solved.solution.primal, solved.solution.multipliers);
  return solved;
}

inline Solved solve(const Problem& problem, const Scheme& scheme, const Grid& grid, const Motion& start,
                    double tolerance = 1e-10, CostForm form = CostForm::bolza) {
  return solve(problem, scheme.method, scheme.tableau(), grid, start, tolerance, form);
}

/// One motion from which all methods and grids start, so that they end on the same branch: DMOC's answer on 96
/// intervals. Solved once per problem.
inline const Motion& common_start(const Problem& problem) {
  static std::map<std::string, Motion> motions;
  auto found = motions.find(problem.name());
  if (found == motions.end()) {
    const Solved solved = solve(problem, {"dmoc", 1}, Grid::uniform(96), guessed_motion(problem));
    found = motions.emplace(problem.name(), smooth_motion(solved.trajectory)).first;
  }
  return found->second;
}

/// A grid graded smoothly towards the start: τ(x) = x + ¼ x (x - 1), widths vary by a factor of 5/3.
inline Grid graded_grid(Eigen::Index intervals) {
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(intervals + 1, 0.0, 1.0);
  Eigen::VectorXd nodes = (x + 0.25 * x * (x - 1.0)).matrix();
  nodes[0] = 0.0;
  nodes[intervals] = 1.0;
  return Grid::from_nodes(std::move(nodes));
}

/// Largest magnitude of rows minus their bounds: the residual of a program whose rows are equalities.
inline double row_residual(Transcription& transcription, const Eigen::VectorXd& x) {
  Eigen::VectorXd rows(static_cast<Eigen::Index>(transcription.constraint_count()));
  transcription.constraints(x, rows);
  return (rows - transcription.constraint_lower()).lpNorm<Eigen::Infinity>();
}

}  // namespace dmocbench::tests
