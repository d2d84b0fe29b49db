// Solves the pendulum by DMOC and Ipopt, and writes its motion.
#include <fstream>
#include <iostream>

#include <pendulum.hpp>

#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

int main() {
  const Pendulum problem;
  Transcription program(problem, *make_element("dmoc"), gauss_tableau(1), Grid::uniform(64));
  const Solution solution = make_solver("ipopt")->solve(program, sample(program, guessed_motion(problem)));
  const Trajectory motion = read_trajectory(program, solution.primal, solution.multipliers);
  std::ofstream table("pendulum.csv");
  table << "t,theta,omega\n";
  for (Eigen::Index k = 0; k <= motion.intervals(); ++k)
    table << motion.node_times[k] << ',' << motion.q(k, 0) << ',' << motion.v(k, 0) << '\n';
  std::cout << "pendulum: " << name_of(solution.status) << ", cost " << motion.cost << ", table pendulum.csv\n";
  return is_solved(solution.status) ? 0 : 1;
}
