// A problem of one's own: a pendulum swings up in 4 s with least torque. Solved by DMOC and Ipopt.
#include <iostream>
#include <numbers>

#include "methods/mechanics/problem.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/element.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"

using namespace dmocbench;

class Pendulum final : public Problem {
 public:
  std::string name() const override { return "pendulum"; }
  std::string description() const override { return "a pendulum swings up with least torque"; }
  std::string source() const override { return "an example"; }
  std::vector<std::string> configuration_names() const override { return {"theta"}; }
  std::vector<std::string> control_names() const override { return {"torque"}; }

  Expression lagrangian(const State& x) const override {
    constexpr double gravity = 9.81;  // m/s^2; mass 1 kg, length 1 m, θ = 0 hangs down
    return 0.5 * x.v[0] * x.v[0] + gravity * cos(x.q[0]);
  }
  ExpressionVector force(const ControlledState& x) const override { return x.u; }
  Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }

  BoundaryState initial_state() const override { return at_rest(0.0); }
  BoundaryState final_state() const override { return at_rest(std::numbers::pi); }
  double horizon() const override { return 4.0; }

 private:
  static BoundaryState at_rest(double theta) { return {Eigen::VectorXd::Constant(1, theta), Eigen::VectorXd::Zero(1)}; }
};

int main() {
  const Pendulum problem;
  Transcription program(problem, *make_element("dmoc"), gauss_tableau(1), Grid::uniform(64));
  const Solution solution = make_solver("ipopt")->solve(program, sample(program, guessed_motion(problem)));
  std::cout << "pendulum: " << name_of(solution.status) << ", cost " << solution.objective << '\n';
  return solution.status == Status::solved ? 0 : 1;
}
