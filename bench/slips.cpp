// Statements of the paper that cannot be meant as printed, each evaluated as printed and as meant.
#include <numbers>

#include <fmt/format.h>

#include "bench/experiment/experiment.hpp"
#include "bench/experiment/metadata.hpp"
#include "bench/experiment/process_pool.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/experiment/start_provider.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "problems/registry.hpp"

namespace dmocbench::programs {

struct Slip {
  std::string problem;
  std::string name;
  std::string where;
  std::string printed;
  std::string meant;
  std::string quantity;  ///< what tells both apart
  double as_printed;
  double as_meant;
  double required;
};

/// The derivative of the potential's last term with respect to θ₂ where the paper says the arm is in equilibrium.
Slip potential_without_sine() {
  const auto problem = make_problem("two_link_manipulator");
  const double weight =
      0.5 * problem->parameter("mass_2") * problem->parameter("gravity") * problem->parameter("length_2");
  const ExpressionVector theta = input_vector(0, 1);
  const auto torque_upright = [&](const Expression& potential) {
    const std::vector<double> upright{std::numbers::pi / 2.0};
    return -replay<double>(Schedule(gradient(potential, theta)), std::span<const double>(upright)).front();
  };
  return {.problem = problem->name(),
          .name = "potential",
          .where = "section 4.2.2, V(q)",
          .printed = "last term of V is 1/2 m_2 g l_2 theta_2",
          .meant = "1/2 m_2 g l_2 sin theta_2",
          .quantity = "torque on theta_2 at the equilibrium (pi/2, pi/2)",
          .as_printed = torque_upright(weight * theta[0]),
          .as_meant = torque_upright(weight * sin(theta[0])),
          .required = 0.0};
}

/// Free variations at t = 0 give ∂L/∂q̇(0) = p⁰; the paper prints p^T there, and p⁰ at T.
Slip swapped_momenta(const Problem& problem, const Trajectory& motion) {
  const BoundaryState first = problem.initial_state();
  LegendreTransform legendre{TracedProblem(problem)};
  const Eigen::Index last = motion.q.rows() - 1;
  return {.problem = problem.name(),
          .name = "boundary_momenta",
          .where = "eq:bounds_impuls1, eq:bounds_impuls2",
          .printed = "dL/dq' = p^T at t = 0 and p^0 at t = T",
          .meant = "p^0 at t = 0, p^T at t = T",
          .quantity = "angular momentum at t = 0 on the optimal transfer",
          .as_printed = motion.p(last, 1),
          .as_meant = motion.p(0, 1),
          .required = legendre.momentum(first.q, first.v, 0.0)[1]};
}

/// ṗ = -∇_q H + f; the Mayer paragraph writes -∇_p H + f. On the orbit ∇_q H has no φ part and ∇_p H has φ̇: integrated
/// over the horizon, Δp_φ = ∫ f_φ dt as meant, and ∫ f_φ dt - Δφ as printed.
Slip mayer_gradient(const Problem& problem, const Trajectory& motion) {
  const Eigen::Index last = motion.q.rows() - 1;
  double work = 0.0;
  for (Eigen::Index k = 0; k < motion.intervals(); ++k) {
    work += (motion.node_times[k + 1] - motion.node_times[k]) * motion.stage_q(k, 0) * motion.stage_u(k, 0);
  }
  return {.problem = problem.name(),
          .name = "mayer_form",
          .where = "eq:dHOCP1_mayer and below",
          .printed = "eta = -grad_p H + f",
          .meant = "eta = -grad_q H + f",
          .quantity = "change of angular momentum over the optimal transfer",
          .as_printed = work - (motion.q(last, 1) - motion.q(0, 1)),
          .as_meant = work,
          .required = motion.p(last, 1) - motion.p(0, 1)};
}

const Columns<Slip> columns{
    {"problem", "", "name of the problem", &Slip::problem},
    {"slip", "", "short name of the statement", &Slip::name},
    {"where", "", "in the paper", &Slip::where},
    {"printed", "", "what is printed", &Slip::printed},
    {"meant", "", "what is meant", &Slip::meant},
    {"quantity", "", "what tells both apart", &Slip::quantity},
    {"value_as_printed", "", "its value as printed", &Slip::as_printed},
    {"value_as_meant", "", "its value as meant", &Slip::as_meant},
    {"required_value", "", "its value as it has to be", &Slip::required},
};

int evaluate_slips(CommandLine& line) {
  std::filesystem::path out = "results";
  line.option("--out", out, "folder for the results");
  const std::vector<std::string> command_line = line.parse();
  listen_for_interrupt();
  const OutputFolder folder(out);
  const ResultLock lock(out / "slips");
  SolverOptions options;
  options.stop_requested = interrupt_requested;
  const std::shared_ptr<const Problem> orbit = make_problem("orbital_transfer");
  const Trajectory motion =
      StartProvider({}, options)
          .solve(
              {.problem = orbit, .method = "dmoc", .tableau = "gauss", .solver = "ipopt", .grid = Grid::uniform(128)});
  const std::vector<Slip> slips{potential_without_sine(), swapped_momenta(*orbit, motion),
                                mayer_gradient(*orbit, motion)};
  const std::filesystem::path file = out / "slips.csv";
  write_file(file, table_of(columns, slips).csv());
  write_complete_run(out / "slips.json", command_line, {file});
  fmt::print("slips: {} rows: {}\n", slips.size(), file.string());
  return 0;
}

}  // namespace dmocbench::programs

int main(int argc, char** argv) {
  return dmocbench::run_program(
      "slips", "Statements of the paper that cannot be meant as printed, evaluated as printed and as meant: slips.csv.",
      argc, argv, dmocbench::programs::evaluate_slips);
}
