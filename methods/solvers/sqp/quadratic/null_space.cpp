#include "methods/solvers/sqp/quadratic/null_space.hpp"

#include <cstddef>
#include <vector>

namespace dmocbench::sqp {

Eigen::VectorXd null_space_times(const Iterate& iterate, const Eigen::VectorXd& of_superbasics) {
  const QuadraticProgram& program = iterate.program();
  Eigen::VectorXd change = Eigen::VectorXd::Zero(program.column_count());
  change(iterate.sets().superbasics()) = of_superbasics;
  const Eigen::Index n = program.variable_count();
  const Eigen::VectorXd moved = program.rows * change.head(n) - change.tail(program.row_count());
  change(iterate.sets().basics()) = -iterate.basis().solve(moved);
  return change;
}

Eigen::VectorXd null_space_transposed_times(const Iterate& iterate, const Eigen::VectorXd& of_variables) {
  const QuadraticProgram& program = iterate.program();
  Eigen::VectorXd all = Eigen::VectorXd::Zero(program.column_count());
  all.head(program.variable_count()) = of_variables;
  const Eigen::VectorXd multipliers = iterate.basis().solve_transposed(iterate.at_basics(all));
  return iterate.at_superbasics(all - program.transposed_times(multipliers));
}

Eigen::MatrixXd reduced_matrix(const Iterate& iterate) {
  const QuadraticProgram& program = iterate.program();
  const std::vector<Eigen::Index>& superbasics = iterate.sets().superbasics();
  if (superbasics.empty()) return {};  // Eigen's triangular product looks at its first entry
  const Eigen::Index n = program.variable_count();
  Eigen::MatrixXd directions =
      Eigen::MatrixXd::Zero(program.column_count(), static_cast<Eigen::Index>(superbasics.size()));
  for (std::size_t place = 0; place < superbasics.size(); ++place) {
    auto direction = directions.col(static_cast<Eigen::Index>(place));
    direction(iterate.sets().basics()) = -iterate.basis().solve(program.column(superbasics[place]));
    direction[superbasics[place]] = 1.0;
  }
  const Eigen::MatrixXd of_variables = directions.topRows(n);
  const Eigen::MatrixXd curved = program.hessian->times(of_variables);
  Eigen::MatrixXd result(directions.cols(), directions.cols());
  result.triangularView<Eigen::Lower>() = of_variables.transpose() * curved;
  result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
  return result;
}

}  // namespace dmocbench::sqp
