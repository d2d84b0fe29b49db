#include "methods/indirect/indirect_solution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

constexpr double most_digits = 16.0;

/// The largest difference of one kind of quantity, and its largest value.
class LargestDifference {
 public:
  void add(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
    if (one.size() == 0) return;
    difference_ = std::max(difference_, (one - other).lpNorm<Eigen::Infinity>());
    largest_ = std::max({largest_, one.lpNorm<Eigen::Infinity>(), other.lpNorm<Eigen::Infinity>()});
  }
  /// `scale` makes the quantity of order 1, so that a vanishing one is recognised.
  [[nodiscard]] double relative(double scale) const {
    constexpr double vanishing = 1e-8;
    return largest_ * scale > vanishing ? difference_ / largest_ : difference_ * scale;
  }

 private:
  double difference_ = 0.0;
  double largest_ = 0.0;
};

Eigen::VectorXd joined(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd both(a.size() + b.size());
  both << a, b;
  return both;
}

void require_rows_and_columns(const Eigen::MatrixXd& table, Eigen::Index rows, Eigen::Index columns) {
  if (table.rows() == rows && table.cols() == columns && table.allFinite()) return;
  throw Error("the indirect solution has a matrix of the wrong size or an entry that is not finite; solve it again");
}

}  // namespace

double IndirectAgreement::worst() const { return std::max({state, costate, control, cost}); }

double IndirectAgreement::digits() const {
  return std::min(most_digits, -std::log10(std::max(worst(), std::numeric_limits<double>::min())));
}

IndirectSolution::IndirectSolution(const Problem& problem, CollocatedExtremal extremal,
                                   const IndirectAgreement& agreement)
    : function_(std::make_shared<PontryaginFunction>(problem)), extremal_(std::move(extremal)), agreement_(agreement) {
  if (extremal_.stages < 1 || extremal_.intervals() < 1 || !(extremal_.horizon > 0.0)) {
    throw Error("an indirect solution needs at least one stage, one interval and a positive horizon; solve it again");
  }
  const Eigen::Index stages = extremal_.stages * extremal_.intervals();
  require_rows_and_columns(extremal_.nodes, function_->state_size(), extremal_.intervals() + 1);
  require_rows_and_columns(extremal_.rates, function_->state_size(), stages);
  require_rows_and_columns(extremal_.algebraic, function_->algebraic_size(), stages);
  tableau_ = high_order_gauss_tableau(extremal_.stages);
}

IndirectPoint IndirectSolution::at(double t) const {
  const double inside = std::clamp(t, 0.0, extremal_.horizon);
  ExtremalPoint point = point_on(extremal_, tableau_, inside);
  static_cast<void>(function_->evaluate(point.y, inside, point.z));
  const Eigen::Index n = function_->configuration_size();
  const double scale = function_->cost_scale();
  return {.q = point.y.segment(0, n),
          .p = point.y.segment(n, n),
          .v = point.z.head(n),
          .psi_q = point.y.segment(2 * n, n) / scale,
          .psi_p = point.y.segment(3 * n, n) / scale,
          .u = point.z.segment(n, function_->control_size())};
}

Eigen::VectorXd IndirectSolution::node_times() const {
  return Eigen::VectorXd::LinSpaced(extremal_.intervals() + 1, 0.0, extremal_.horizon);
}

double IndirectSolution::cost() const { return extremal_.cost / function_->cost_scale(); }

std::optional<double> IndirectSolution::hamiltonian_drift() const {
  if (!function_->is_autonomous()) return std::nullopt;
  double smallest = std::numeric_limits<double>::infinity();
  double largest = -smallest;
  double terms = std::numeric_limits<double>::min();
  const Eigen::VectorXd times = node_times();
  for (const double t : times) {
    ExtremalPoint point = point_on(extremal_, tableau_, t);
    const PontryaginFunction::Values values = function_->evaluate(point.y, t, point.z);
    smallest = std::min(smallest, values.hamiltonian);
    largest = std::max(largest, values.hamiltonian);
    terms = std::max(terms, values.hamiltonian_terms);
  }
  return (largest - smallest) / terms;
}

Trajectory IndirectSolution::sampled_like(const Trajectory& trajectory) const {
  const Eigen::Index n = function_->configuration_size();
  Trajectory sampled;
  sampled.tableau = trajectory.tableau;
  sampled.node_times = trajectory.node_times;
  sampled.stage_times = trajectory.stage_times;
  sampled.cost = cost();
  /// Fills tables with a row per time.
  const auto fill = [&](const Eigen::VectorXd& times, Eigen::MatrixXd& q, Eigen::MatrixXd& p, Eigen::MatrixXd& v,
                        Eigen::MatrixXd& psi_q, Eigen::MatrixXd& psi_p) {
    Eigen::MatrixXd u(times.size(), function_->control_size());
    for (Eigen::MatrixXd* table : {&q, &p, &v, &psi_q, &psi_p}) table->resize(times.size(), n);
    for (Eigen::Index row = 0; row < times.size(); ++row) {
      const IndirectPoint point = at(times[row]);
      q.row(row) = point.q.transpose();
      p.row(row) = point.p.transpose();
      v.row(row) = point.v.transpose();
      psi_q.row(row) = point.psi_q.transpose();
      psi_p.row(row) = point.psi_p.transpose();
      u.row(row) = point.u.transpose();
    }
    return u;
  };
  static_cast<void>(fill(sampled.node_times, sampled.q, sampled.p, sampled.v, sampled.psi_q, sampled.psi_p));
  sampled.stage_u = fill(sampled.stage_times, sampled.stage_q, sampled.stage_p, sampled.stage_v, sampled.stage_psi_q,
                         sampled.stage_psi_p);
  return sampled;
}

Trajectory IndirectSolution::trajectory() const {
  Trajectory grid;
  grid.tableau = tableau_;
  grid.node_times = node_times();
  const Eigen::Index s = tableau_.stages();
  grid.stage_times.resize(s * extremal_.intervals());
  for (Eigen::Index k = 0; k < extremal_.intervals(); ++k) {
    const double step = grid.node_times[k + 1] - grid.node_times[k];
    grid.stage_times.segment(k * s, s) = (grid.node_times[k] + step * tableau_.c.array()).matrix();
  }
  return sampled_like(grid);
}

IndirectAgreement compare(const IndirectSolution& one, const IndirectSolution& other, double cost_scale) {
  const Eigen::VectorXd nodes = one.node_times();
  const Eigen::VectorXd other_nodes = other.node_times();
  std::vector<double> times(other_nodes.begin(), other_nodes.end());
  for (Eigen::Index k = 0; k + 1 < nodes.size(); ++k) {
    // Two points away from the middle, where neither polynomial is especially accurate.
    for (const double tau : {0.0, 0.31, 0.83}) times.push_back(nodes[k] + tau * (nodes[k + 1] - nodes[k]));
  }
  LargestDifference configuration;
  LargestDifference velocity;
  LargestDifference momentum;
  LargestDifference costate;
  LargestDifference control;
  for (const double t : times) {
    const IndirectPoint a = one.at(t);
    const IndirectPoint b = other.at(t);
    configuration.add(a.q, b.q);
    velocity.add(a.v, b.v);
    momentum.add(a.p, b.p);
    costate.add(joined(a.psi_q, a.psi_p), joined(b.psi_q, b.psi_p));
    control.add(a.u, b.u);
  }
  LargestDifference cost;
  cost.add(Eigen::VectorXd::Constant(1, one.cost()), Eigen::VectorXd::Constant(1, other.cost()));
  return {.state = std::max({configuration.relative(1.0), velocity.relative(1.0), momentum.relative(1.0)}),
          .costate = costate.relative(cost_scale),
          .control = control.relative(1.0),
          .cost = cost.relative(cost_scale)};
}

}  // namespace dmocbench
