// Solves the pendulum by DMOC and Ipopt, writes its trajectory and reads it back, and makes a problem of the suite.
#include <cstdlib>
#include <iostream>

#include <dmocbench/dmocbench.hpp>
#include <dmocbench/problems.hpp>
#include <pendulum.hpp>

static_assert(DMOCBENCH_VERSION_MAJOR > 0 || DMOCBENCH_VERSION_MINOR >= 1);

int main() try {
  const Pendulum problem;
  Transcription program(problem, *make_element("dmoc"), gauss_tableau(1), Grid::uniform(64));
  const Solution solution = make_solver("ipopt")->solve(program, sample(program, guessed_motion(problem)));
  const Trajectory motion = read_trajectory(program, solution.primal, solution.multipliers);
  write_motion(problem, motion, "pendulum_nodes.csv");
  const bool is_kept = read_motion_tables(problem, "pendulum_nodes.csv").q == motion.q;
  std::cout << "dmocbench " DMOCBENCH_VERSION ", pendulum: " << name_of(solution.status) << ", cost " << motion.cost
            << ", tables pendulum_nodes.csv and pendulum_stages.csv\n";
  const bool is_made = make_problem("cart_pole")->name() == "cart_pole";
  return is_solved(solution.status) && is_kept && is_made ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const Error& error) {
  std::cerr << error.what() << '\n';
  return EXIT_FAILURE;
}
