#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A rocket rises as high as its fuel lets it, Goddard's problem with the data of COPS.
///
/// q = h, the distance from the centre of the Earth, y = m, ṁ = -u/c, 0 <= u <= 3.5 the thrust; L = m (½ḣ² + 1/h), and
/// with the drag D = 310 ḣ² exp(-500 (h - 1)) the force f = u - D + ṁ ḣ leaves m ḧ = u - D - m/h². From rest at h = 1
/// and m = 1 to m = 0.6, T and ḣ(T) free; Φ = -h(T). c = ½. Lengths are radii of the Earth, forces initial weights. The
/// optimal thrust is largest, then singular, then 0: since T is free and time does not enter, the Hamiltonian vanishes,
/// and on the singular arc m/h² = D (1 + ḣ/c). The three arcs are thus one integration.
class GoddardRocket final : public Problem {
 public:
  [[nodiscard]] std::string name() const override { return "goddard_rocket"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {
        .description = "rocket with drag that rises to the largest altitude",
        .title = "Goddard rocket",
        .axis_units = AxisUnits::pure_numbers(),
        .source = "Dolan, More, Munson: Benchmarking optimization software with COPS 3.0, ANL/MCS-TM-273, problem 10",
        .guess = "h = 1 + 0.01 s (2 - s), s = t/T, T = 0.2; mass on a straight line, u = 1.75",
        .time_unit = {.name = "", .factor = 1.0},
        .reference = ReferenceOptimum{.objective = -1.0128369183175,
                                      .digits = 13,
                                      .certificate = "integration of the three arcs that the maximum principle allows",
                                      .published = {{-1.01283, "COPS 3.0"}}},
        .picture = [](const ControlledState& x) -> Picture {
          return {{"altitude", "", x.q[0] - 1.0}, {"mass", "", x.y[0]}, {"thrust", "", x.u[0]}};
        }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"h"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"thrust"}; }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"mass"}; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    constexpr double exhaust_velocity = 0.5;
    return ExpressionVector{{-x.u[0] / exhaust_velocity}};
  }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return x.y[0] * (0.5 * x.v[0] * x.v[0] + 1.0 / x.q[0]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression drag = 310.0 * x.v[0] * x.v[0] * exp(-500.0 * (x.q[0] - 1.0));
    return ExpressionVector{{x.u[0] - drag + first_order_rates(x)[0] * x.v[0]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& /*x*/) const override { return 0.0; }
  [[nodiscard]] Expression final_cost(const State& last) const override { return -last.q[0]; }

  [[nodiscard]] BoundaryState initial_state() const override { return at(1.0, 1.0); }
  [[nodiscard]] BoundaryState final_state() const override { return at(1.01, 0.6); }
  [[nodiscard]] double horizon() const override { return 0.2; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_configuration(0).free_velocity(0);
    bounds.horizon = {0.05, 1.0};
    bounds.u = Bounds::all(1, 0.0, 3.5);
    return bounds;
  }
  [[nodiscard]] MotionPoint guess(double t) const override {
    MotionPoint point = Problem::guess(t);
    const double s = t / horizon();
    point.q[0] = 1.0 + 0.01 * s * (2.0 - s);
    point.v[0] = 0.02 * (1.0 - s) / horizon();
    point.u[0] = 1.75;
    return point;
  }

 private:
  static BoundaryState at(double height, double mass) {
    return {.q = Eigen::VectorXd::Constant(1, height),
            .v = Eigen::VectorXd::Zero(1),
            .y = Eigen::VectorXd::Constant(1, mass)};
  }
};

}  // namespace dmocbench
