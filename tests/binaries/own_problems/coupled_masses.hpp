#pragma once

#include "methods/expression/vectors.hpp"
#include "methods/mechanics/problem.hpp"

namespace own {

/// Two masses whose motions are coupled, L = ½ vᵀMv with M = (2 1; 1 3), force u and cost ½ uᵀM⁻¹u: from rest to rest
/// over d = (1, 1) in 1 s the least cost is 6 dᵀMd = 42.
struct CoupledMasses final : dmocbench::Problem {
  [[nodiscard]] static dmocbench::ExpressionMatrix mass() {
    dmocbench::ExpressionMatrix m(2, 2);
    m << 2.0, 1.0, 1.0, 3.0;
    return m;
  }
  [[nodiscard]] std::string name() const override { return "coupled_masses"; }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"push_x", "push_y"}; }
  [[nodiscard]] dmocbench::Expression lagrangian(const dmocbench::State& x) const override {
    const dmocbench::ExpressionVector momentum = mass() * x.v;
    return 0.5 * x.v.dot(momentum);
  }
  [[nodiscard]] dmocbench::ExpressionVector force(const dmocbench::ControlledState& x) const override { return x.u; }
  [[nodiscard]] dmocbench::Expression running_cost(const dmocbench::ControlledState& x) const override {
    return 0.5 * x.u.dot(dmocbench::solve_symmetric(mass(), x.u));
  }
  [[nodiscard]] dmocbench::BoundaryState initial_state() const override {
    return dmocbench::BoundaryState::at_rest(Eigen::VectorXd::Zero(2));
  }
  [[nodiscard]] dmocbench::BoundaryState final_state() const override {
    return dmocbench::BoundaryState::at_rest(Eigen::VectorXd::Ones(2));
  }
  [[nodiscard]] double horizon() const override { return 1.0; }
};

}  // namespace own
