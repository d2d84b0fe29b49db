#include "tests/support/solving.hpp"

#include <map>

#include "methods/transcription/elements/families.hpp"

namespace dmocbench::tests {

std::vector<Scheme> schemes_of(const std::vector<std::string>& families, int most_stages) {
  std::vector<Scheme> schemes;
  for (const std::string& method : paper_families()) {
    for (const std::string& family : families) {
      for (const int s : tableau_stages(family)) {
        if (s <= most_stages) schemes.push_back({method, s, family});
      }
    }
  }
  return schemes;
}

std::vector<Scheme> all_schemes(int most_stages) { return schemes_of({"gauss", "lobatto"}, most_stages); }

std::vector<Way> ways_by(const std::vector<std::string>& solvers) {
  std::vector<Way> ways;
  for (const Scheme& scheme : all_schemes()) {
    for (const std::string& solver : solvers) ways.push_back({scheme, solver});
  }
  return ways;
}

std::vector<Scheme> schemes_with_shared_controls(int most_stages) {
  return schemes_of({"lobatto_shared"}, most_stages);
}

bool takes_constraints(const Problem& problem, const Scheme& scheme) {
  return dmocbench::takes_constraints(*make_element(scheme.method), TracedProblem(problem), scheme.tableau());
}

std::unique_ptr<Transcription> transcribe(const Problem& problem, const Scheme& scheme, const Grid& grid) {
  return std::make_unique<Transcription>(problem, *make_element(scheme.method), scheme.tableau(), grid);
}

Solved solve(const Problem& problem, const std::string& method, const Tableau& tableau, const Grid& grid,
             const Motion& start, double tolerance, CostForm form) {
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

Solved solve(const Problem& problem, const Scheme& scheme, const Grid& grid, const Motion& start, double tolerance,
             CostForm form) {
  return solve(problem, scheme.method, scheme.tableau(), grid, start, tolerance, form);
}

const Motion& common_start(const Problem& problem) {
  static std::map<std::string, Motion> motions;
  auto found = motions.find(problem.name());
  if (found == motions.end()) {
    const Solved solved = solve(problem, {"dmoc", 1}, Grid::uniform(96), guessed_motion(problem));
    found = motions.emplace(problem.name(), smooth_motion(solved.trajectory)).first;
  }
  return found->second;
}

Grid graded_grid(Eigen::Index intervals) {
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(intervals + 1, 0.0, 1.0);
  Eigen::VectorXd nodes = (x + 0.25 * x * (x - 1.0)).matrix();
  nodes[0] = 0.0;
  nodes[intervals] = 1.0;
  return Grid::from_nodes(std::move(nodes));
}

double row_residual(Transcription& transcription, const Eigen::VectorXd& x) {
  Eigen::VectorXd rows(static_cast<Eigen::Index>(transcription.constraint_count()));
  transcription.constraints(x, rows);
  return (rows - transcription.constraint_lower()).lpNorm<Eigen::Infinity>();
}

Eigen::MatrixXd free_columns(Transcription& program, const Eigen::VectorXd& x) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  program.jacobian(x, values);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(program.constraint_count()), x.size());
  program.jacobian_structure().for_each(
      [&](Eigen::Index entry, int row, int column) { matrix(row, column) = values[entry]; });
  std::vector<Eigen::Index> columns;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (!is_fixed(program, i)) columns.push_back(i);
  }
  return matrix(Eigen::all, columns);
}

}  // namespace dmocbench::tests
