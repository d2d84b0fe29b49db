#include "methods/transcription/motions/guess_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/mechanics/formulas_along_motion.hpp"
#include "methods/mechanics/holonomic_constraints.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/problem_check.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

namespace {

/// The beginning of a sentence about the guess at time t.
std::string place_of(double t, const Problem& problem, const Grid& grid) {
  const Eigen::VectorXd& nodes = grid.relative_times();
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), t / problem.horizon());
  const auto interval = std::clamp<std::ptrdiff_t>(above - nodes.begin() - 1, 0, nodes.size() - 2);
  return fmt::format("{}: at its guess in interval {} (t = {:g}) ", problem.name(), interval, t);
}

/// The fault of a point of the guess, or empty.
std::string flaw_of(const MotionPoint& point, const TracedProblem& traced) {
  std::string flaw =
      flaw_of_sizes(point, traced.configuration_size(), traced.control_size(), traced.first_order_size());
  if (!flaw.empty()) return flaw;
  const bool is_finite = point.q.allFinite() && point.v.allFinite() && point.u.allFinite() && point.y.allFinite();
  return is_finite ? "" : "the guess itself is not a number";
}

/// The first formula that is not a number in a row of `TracedProblem::table`, with its entry; empty if there is none.
std::string nan_in(const Eigen::VectorXd& values, const TracedProblem& traced) {
  struct Formula {
    const char* name;
    Eigen::Index first;
    Eigen::Index entries;
  };
  const Eigen::Index n = traced.configuration_size();
  for (const Formula& formula : {Formula{"lagrangian by q (L_q)", n, n},
                                 {"lagrangian by q̇ (L_v)", 0, n},
                                 {"force", 2 * n, n},
                                 {"running_cost", 3 * n, 1},
                                 {"path_constraints", 3 * n + 1, traced.path_constraint_count()}}) {
    for (Eigen::Index i = 0; i < formula.entries; ++i) {
      if (std::isfinite(values[formula.first + i])) continue;
      return formula.name + (formula.entries > 1 ? fmt::format("[{}]", i) : "");
    }
  }
  return "";
}

}  // namespace

GuessMagnitudes check_guess(const Problem& problem, const TracedProblem& traced, const Grid& grid, bool needs_mass) {
  constexpr int count = 64;
  const Eigen::Index n = traced.configuration_size();
  const double horizon = problem.horizon();
  std::vector<MotionPoint> points;
  Eigen::VectorXd times(count + 2);
  for (int i = 0; i < count; ++i) {
    times[i] = horizon * (i + 0.5) / count;
    points.push_back(call_formula(problem, "guess", [&] { return problem.guess(times[i]); }));
    const std::string flaw = flaw_of(points.back(), traced);
    if (!flaw.empty()) throw Error(place_of(times[i], problem, grid) + flaw);
  }
  times.tail(2) << 0.0, horizon;
  for (const BoundaryState& end : {problem.initial_state(), problem.final_state()}) {
    points.push_back({end.q, end.v, Eigen::VectorXd::Zero(traced.control_size()), end.y});
  }

  const Eigen::MatrixXd table = traced.table(points, times);
  GuessMagnitudes magnitudes;
  std::optional<HolonomicConstraints> constraints;
  if (traced.holonomic_count() > 0) constraints.emplace(traced);
  FormulaCheck check(problem, FormulaCheck::Derivatives::second);
  for (Eigen::Index i = 0; i < table.rows(); ++i) {
    const Eigen::VectorXd values = table.row(i);
    const Eigen::MatrixXd mass = values.segment(3 * n + 1 + traced.path_constraint_count(), n * n).reshaped(n, n);
    const Eigen::VectorXd& q = points[static_cast<std::size_t>(i)].q;
    magnitudes.largest_configuration = std::max(magnitudes.largest_configuration, q.lpNorm<Eigen::Infinity>());
    magnitudes.largest_mass = std::max(magnitudes.largest_mass, mass.lpNorm<Eigen::Infinity>());
    if (i >= count) continue;  // the ends are only measured
    std::string undefined = nan_in(values, traced);
    if (undefined.empty()) undefined = check.undefined_at(points[static_cast<std::size_t>(i)], times[i]);
    if (!undefined.empty()) {
      throw Error(place_of(times[i], problem, grid) + undefined +
                  " is not a number; give a guess that keeps away from the singularity, and bound the coordinates away "
                  "from it");
    }
    if (constraints) {
      constraints->evaluate(q);
      if (!is_invertible(saddle_matrix(mass, constraints->jacobian()))) {
        throw Error(place_of(times[i], problem, grid) +
                    "(L_vv, G'; G, 0) is singular: constraints, G = dg/dq, are dependent there, or L is not regular");
      }
      if (!needs_mass) continue;
    }
    if (!is_invertible(mass)) {
      if (constraints) {
        throw Error(place_of(times[i], problem, grid) +
                    "L_vv is singular; with constraints g(q) = 0 take dmoc with --tableau gauss --stages 1");
      }
      throw Error(place_of(times[i], problem, grid) + "L_vv is singular, so the Lagrangian is not regular");
    }
  }
  return magnitudes;
}

}  // namespace dmocbench
