#include "methods/program/kkt_residual.hpp"

#include <algorithm>
#include <cmath>

#include "methods/error.hpp"
#include "methods/runtime/resize_unwritten.hpp"

namespace dmocbench {

namespace {

void require_size(Eigen::Index actual, std::size_t wanted, const char* what) {
  if (static_cast<std::size_t>(actual) != wanted) {
    throw Error(std::string("the residual needs ") + std::to_string(wanted) + " " + what + ", got " +
                std::to_string(actual));
  }
}

/// The larger of both; NaN wins, so that it cannot hide.
double largest(double a, double b) { return std::isnan(b) ? b : std::max(a, b); }

double outside(const Eigen::VectorXd& x, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  double worst = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    worst = largest(worst, std::max(lower[i] - x[i], x[i] - upper[i]));
    if (std::isnan(x[i])) return x[i];
  }
  return worst;
}

/// What is left of the slope g, which the bound at a distance d, on the side where g points down, may take up with its
/// multiplier: without the multiplier |g| of stationarity, with it |g| d of complementarity. Without a bound there it
/// is |g|, at the bound 0.
double bounded_stationarity(double slope, double x, double lower, double upper) {
  const double distance = slope > 0.0 ? x - lower : upper - x;
  return std::abs(slope) * std::min(1.0, distance);
}

/// Stationarity of row i: an equality's multiplier is free; an inequality's pushes away from the bound it is at.
double row_stationarity(double multiplier, double row, double lower, double upper) {
  return lower == upper ? 0.0 : bounded_stationarity(-multiplier, std::clamp(row, lower, upper), lower, upper);
}

Eigen::VectorXd rows_at(NonlinearProgram& program, const Eigen::VectorXd& primal) {
  Eigen::VectorXd rows;
  resize_unwritten(rows, static_cast<Eigen::Index>(program.constraint_count()));
  program.constraints(primal, rows);
  return rows;
}

double violation_of(const NonlinearProgram& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& rows) {
  return largest(outside(rows, program.constraint_lower(), program.constraint_upper()),
                 outside(primal, program.variable_lower(), program.variable_upper()));
}

}  // namespace

KktResidual kkt_residual(NonlinearProgram& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers) {
  require_size(primal.size(), program.variable_count(), "variables");
  require_size(multipliers.size(), program.constraint_count(), "multipliers");
  const Eigen::VectorXd rows = rows_at(program, primal);
  KktResidual residual;
  residual.constraint_violation = violation_of(program, primal, rows);

  Eigen::VectorXd slope;
  resize_unwritten(slope, primal.size());
  program.gradient(primal, slope);
  const BlockPattern& pattern = program.jacobian_structure();
  Eigen::VectorXd jacobian;
  resize_unwritten(jacobian, static_cast<Eigen::Index>(pattern.size()));
  program.jacobian(primal, jacobian);
  pattern.for_each([&](Eigen::Index e, int row, int column) { slope[column] += jacobian[e] * multipliers[row]; });
  for (Eigen::Index i = 0; i < primal.size(); ++i) {
    const double lower = program.variable_lower()[i];
    const double upper = program.variable_upper()[i];
    if (lower == upper) continue;
    residual.stationarity = largest(residual.stationarity,
                                    bounded_stationarity(slope[i], std::clamp(primal[i], lower, upper), lower, upper));
  }
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    residual.stationarity = largest(
        residual.stationarity,
        row_stationarity(multipliers[i], rows[i], program.constraint_lower()[i], program.constraint_upper()[i]));
  }
  return residual;
}

double constraint_violation(NonlinearProgram& program, const Eigen::VectorXd& primal) {
  require_size(primal.size(), program.variable_count(), "variables");
  return violation_of(program, primal, rows_at(program, primal));
}

}  // namespace dmocbench
