#include "methods/transcription/guess_check.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

namespace {

/// A function of the problem and the number of its entries.
struct Quantity {
  std::string name;
  Eigen::Index entries;
};

class GuessCheck {
 public:
  GuessCheck(const Problem& problem, const TracedProblem& traced, const Grid& grid)
      : problem_(&problem),
        grid_(&grid),
        n_(traced.configuration_size()),
        quantities_{{"lagrangian by q (L_q)", n_},
                    {"lagrangian by q̇ (L_v)", n_},
                    {"force", n_},
                    {"running_cost", 1},
                    {"path_constraints", traced.path_constraint_count()}},
        formulas_(n_, traced.control_size(),
                  [&](const ControlledState& x) {
                    const TracedProblem::Values values = traced.at(x);
                    ExpressionVector all(3 * n_ + 1 + traced.path_constraint_count());
                    all << values.configuration_force, values.momentum, values.control_force,
                        ExpressionVector::Constant(1, values.running_cost), values.path_constraints;
                    return all;
                  }),
        legendre_(traced) {}

  /// Checks the guess at time t.
  void check_at(double t) {
    const MotionPoint point = problem_->guess(t);
    require_sizes(point, t);
    Eigen::VectorXd values(formulas_.output_count());
    formulas_.evaluate(point.q, point.v, point.u, t, values);
    Eigen::Index first = 0;
    for (const Quantity& quantity : quantities_) {
      for (Eigen::Index i = first; i < first + quantity.entries; ++i) {
        if (!std::isfinite(values[i])) {
          throw Error(where(t) + quantity.name + entry(i - first, quantity.entries) + " is not a number");
        }
      }
      first += quantity.entries;
    }
    measure(point.q, point.v, t);
    if (!is_invertible(legendre_.mass(point.q, point.v, t))) {
      throw Error(where(t) + "L_vv is singular, so the Lagrangian is not regular");
    }
  }

  /// Takes a state into account.
  void measure(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t) {
    magnitudes_.largest_configuration = std::max(magnitudes_.largest_configuration, q.lpNorm<Eigen::Infinity>());
    magnitudes_.largest_mass = std::max(magnitudes_.largest_mass, legendre_.mass(q, v, t).lpNorm<Eigen::Infinity>());
  }

  [[nodiscard]] const GuessMagnitudes& magnitudes() const { return magnitudes_; }

 private:
  [[nodiscard]] std::string where(double t) const {
    const Eigen::VectorXd& nodes = grid_->relative_times();
    const auto above = std::upper_bound(nodes.begin(), nodes.end(), t / problem_->horizon());
    const auto interval = std::clamp<std::ptrdiff_t>(above - nodes.begin() - 1, 0, nodes.size() - 2);
    return fmt::format("{}: at its guess in interval {} (t = {:g}) ", problem_->name(), interval, t);
  }
  static std::string entry(Eigen::Index i, Eigen::Index entries) { return entries > 1 ? fmt::format("[{}]", i) : ""; }
  void require_sizes(const MotionPoint& point, double t) const {
    const auto require = [&](const char* name, const Eigen::VectorXd& part, Eigen::Index size) {
      if (part.size() == size) return;
      throw Error(where(t) + fmt::format("{} has {} entries, expected {}", name, part.size(), size));
    };
    require("q", point.q, n_);
    require("v", point.v, n_);
    require("u", point.u, problem_->control_size());
    if (!point.q.allFinite() || !point.v.allFinite() || !point.u.allFinite()) {
      throw Error(where(t) + "the guess itself is not a number");
    }
  }

  const Problem* problem_;
  const Grid* grid_;
  Eigen::Index n_;
  std::vector<Quantity> quantities_;
  PointFunction formulas_;
  LegendreTransform legendre_;
  GuessMagnitudes magnitudes_;
};

}  // namespace

GuessMagnitudes check_guess(const Problem& problem, const TracedProblem& traced, const Grid& grid) {
  constexpr int points = 64;
  GuessCheck check(problem, traced, grid);
  const double horizon = problem.horizon();
  check.measure(problem.initial_state().q, problem.initial_state().v, 0.0);
  check.measure(problem.final_state().q, problem.final_state().v, horizon);
  for (int i = 0; i < points; ++i) check.check_at(horizon * (i + 0.5) / points);
  return check.magnitudes();
}

}  // namespace dmocbench
