// The misprints of the paper, each formula evaluated as printed and as corrected.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "bench/experiments/invariants/continuous_flow.hpp"
#include "bench/run/restated_problem.hpp"
#include "bench/run/start_provider.hpp"
#include "bench/run/table_run.hpp"
#include "methods/diagnostics/exact_discrete_lagrangian.hpp"
#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/registry.hpp"

namespace dmocbench::misprints_program {

struct Misprint {
  std::string problem;
  std::string name;
  std::string where;
  std::string printed;
  std::string meant;
  std::string quantity;  ///< distinguishes both
  double as_printed;
  double as_meant;
  double required;
};

/// The derivative of the potential's last term with respect to θ₂ where, as the paper states, the arm is at rest.
Misprint potential_without_sine() {
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
Misprint swapped_momenta(const Problem& problem, const Trajectory& motion) {
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
Misprint mayer_gradient(const Problem& problem, const Trajectory& motion) {
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

/// The control at T of the two shaken masses when their final state costs ½w(|q|² + |q̇|²): H = -C + λ·f is largest at
/// u = c λ_p₂ ẋ₂, and λ(T) = -∇Φ has p₂ part -w ẋ₂/m₂. As printed, λ(T) = +∇Φ, the sign would be the other one.
Misprint transversality(StartProvider& starts) {
  constexpr double weight = 1e3;
  const std::shared_ptr<const Problem> free = make_problem("double_oscillator");
  // The problem's own scale makes the weight so large that rounding of q(T) alone is above the tolerance.
  const auto problem =
      std::make_shared<RestatedProblem>(free, RestatedProblem::Changes{.final_weight = weight, .cost_scale = 1.0});
  const Trajectory motion =
      starts.solve({.problem = problem, .method = "dmoc", .stages = 4, .solver = "ipopt", .grid = Grid::uniform(128)});
  const double v = motion.v(motion.intervals(), 1);
  const double control = weight * free->parameter("damping") * v * v / free->parameter("mass_2");
  return {.problem = problem->name(),
          .name = "transversality",
          .where = "th:pontryagin",
          .printed = "lambda(T) = grad Phi - grad r alpha",
          .meant = "lambda(T) = -grad Phi - grad r alpha, as H = -C + lambda f is maximised",
          .quantity = "control at T, final state free with the cost 500 (|q|^2 + |q'|^2)",
          .as_printed = control,
          .as_meant = -control,
          .required = control_at(motion, motion.node_times[motion.intervals()])[0]};
}

/// L(η, λ*) - L(η*, λ*) of the double integrator, with q, v and u all moved, none of them at the ends. λ* = (λ_q, λ_p)
/// with λ_p = u* and λ̇_q = 0.
Misprint saddle_point() {
  const auto problem = make_problem("double_integrator");
  constexpr int points = 2000;
  constexpr double pi = std::numbers::pi;
  double difference = 0.0;
  for (int i = 0; i < points; ++i) {
    const double t = (i + 0.5) / points;
    const std::optional<OptimalPoint> at = problem->optimum(t);
    if (!at) throw Error("the double integrator has no closed form with these parameters");
    const double u = at->motion.u[0];
    const double lambda_q = -at->psi_q[0];  // λ = -ψ
    const double lambda_p = -at->psi_p[0];
    // δq = sin²(πt), δv = sin(2πt), δu = cos(3t); η* solves the equations of motion.
    const double moved_u = u + std::cos(3.0 * t);
    const double q_equation = pi * std::sin(2.0 * pi * t) - std::sin(2.0 * pi * t);
    const double v_equation = 2.0 * pi * std::cos(2.0 * pi * t) - std::cos(3.0 * t);
    difference += (0.5 * moved_u * moved_u - 0.5 * u * u + lambda_q * q_equation + lambda_p * v_equation) / points;
  }
  return {.problem = problem->name(),
          .name = "saddle_point",
          .where = "below eq:ocp_Jaug",
          .printed = "L(eta, lambda*) <= L(eta*, lambda*) <= L(eta*, lambda)",
          .meant = "L(eta*, lambda) <= L(eta*, lambda*) <= L(eta, lambda*), as J is minimised",
          .quantity = "sign of L(eta, lambda*) - L(eta*, lambda*) for one eta near the optimum",
          .as_printed = -1.0,
          .as_meant = 1.0,
          .required = std::copysign(1.0, difference)};
}

/// The Lemma and its proof on an interval of the orbit: -D_1 L_d^E - f_d^{E-} = -∫ [L_q - d/dt L_v + f]·∂q/∂q_0 dt +
/// L_v(0), where the bracket vanishes. As printed, with -f in it, the integral would be 2 f_d^{E-}; and along the
/// solution of the Euler-Lagrange equations without force between the same ends L_v(0) is another one.
std::array<Misprint, 2> misprints_of_the_lemma(const Problem& problem) {
  constexpr long double h = 0.5L;
  constexpr long double e = 1e-5L;
  const ExactDiscreteLagrangian exact(
      problem, [](const Expression& t) { return ExpressionVector::Constant(1, 0.1 + 0.1 * sin(t)); });
  const ExactDiscreteLagrangian unforced(problem,
                                         [](const Expression& /*t*/) { return ExpressionVector::Constant(1, 0.0); });
  const BoundaryState first = problem.initial_state();
  const LongVector q_0 = first.q.cast<long double>();
  const LongVector v_start = first.v.cast<long double>();
  const ExactInterval interval = exact.along(q_0, v_start, h);
  const LongVector moved = e * LongVector::Unit(2, 1);
  const auto lagrangian = [&](const LongVector& left) {
    return exact.between(left, interval.q_1, v_start, h).objects.lagrangian;
  };
  const long double slope = (lagrangian(q_0 + moved) - lagrangian(q_0 - moved)) / (2.0L * e);
  LegendreTransform legendre{TracedProblem(problem)};
  const double momentum = legendre.momentum(first.q, first.v, 0.0)[1];
  const Eigen::VectorXd unforced_v = unforced.between(q_0, interval.q_1, v_start, h).v_0.cast<double>();
  const auto force = static_cast<double>(interval.objects.left_force[1]);
  const double transform = static_cast<double>(-slope) - force;
  return {Misprint{.problem = problem.name(),
                   .name = "force_in_lemma",
                   .where = "section 2.3, proof of the Lemma",
                   .printed = "-int [L_q - d/dt L_q' - f] dq/dq_0 dt",
                   .meant = "+f instead of -f in the bracket, which then vanishes",
                   .quantity = "p_phi at the left end of an exact interval",
                   .as_printed = momentum + 2.0 * force,
                   .as_meant = transform,
                   .required = momentum},
          Misprint{.problem = problem.name(),
                   .name = "equations_in_lemma",
                   .where = "section 2.3, the Lemma",
                   .printed = "q_0,1 denotes the solution of the corresponding Euler-Lagrange equations",
                   .meant = "q_0,1 denotes the solution of the forced Euler-Lagrange equations",
                   .quantity = "L_v(0) of q_0,1 along phi, and -D_1 L_d^E - f_d^E-",
                   .as_printed = legendre.momentum(first.q, unforced_v, 0.0)[1],
                   .as_meant = momentum,
                   .required = transform}};
}

/// (q^T, p^T) = 𝔽L(q^N, q̇^N) in a statement about continuous motions, which have no N. Read as the state of the last
/// interval of a discrete one, q̇^N = (q_N - q_{N-1})/h, it misses the momentum that the final state has.
Misprint final_momentum(const Problem& problem, const Trajectory& motion) {
  const Eigen::Index last = motion.intervals();
  const BoundaryState end = problem.final_state();
  LegendreTransform legendre{TracedProblem(problem)};
  const Eigen::VectorXd q = motion.q.row(last).transpose();
  const Eigen::VectorXd v = (motion.q.row(last) - motion.q.row(last - 1)).transpose() / motion.step(last - 1);
  return {.problem = problem.name(),
          .name = "final_momentum",
          .where = "section 3.2, the Proposition (editorial)",
          .printed = "(q^T, p^T) = FL(q^N, q'^N)",
          .meant = "(q^T, p^T) = FL(q^T, q'^T)",
          .quantity = "angular momentum at t = T on the optimal transfer, with q'^N read as (q_N - q_N-1)/h",
          .as_printed = legendre.momentum(q, v, 0.0)[1],
          .as_meant = legendre.momentum(end.q, end.v, 0.0)[1],
          .required = motion.p(last, 1)};
}

/// The ratio of free variables, collocation to DMOC, that the minor iterations of a figure reflect: of a long horizon
/// it is (2n + m)/(n + m). The text gives 1.5.
Misprint figure_of_iterations() {
  const auto ratio = [](const char* name) {
    const auto problem = make_problem(name);
    const auto n = static_cast<double>(problem->configuration_size());
    const auto m = static_cast<double>(problem->control_size());
    return (2.0 * n + m) / (n + m);
  };
  return {.problem = "two_link_manipulator",
          .name = "figure_of_iterations",
          .where = "section 4.2.2, last paragraph, and caption of fig:twolink_iterations (editorial)",
          .printed = "the minor iterations of the two-link manipulator are in fig:kepler_iterations",
          .meant = "they are in fig:twolink_iterations, whose caption reads low thrust orbital transfer",
          .quantity = "ratio of the numbers of variables on the problem of that figure",
          .as_printed = ratio("orbital_transfer"),
          .as_meant = ratio("two_link_manipulator"),
          .required = 1.5};
}

/// Θ_L = L_v dq gives Ω_L = L_vq dq∧dq + L_vv dv∧dq. The form as printed is dq∧dq alone, since L_vv is symmetric.
Misprint lagrangian_form(const std::shared_ptr<const Problem>& problem) {
  const BoundaryState& first = problem->initial_state();
  const Table changes = flow_symplecticity_table({{problem, {first}, 0.0}});
  return {.problem = problem->name(),
          .name = "lagrangian_form",
          .where = "section 2.1, Omega_L",
          .printed = "Omega_L = L_vq dq^dq + L_vv dv^dv",
          .meant = "L_vq dq^dq + L_vv dv^dq",
          .quantity = "largest change of the form along the unforced flow, which preserves it",
          .as_printed = changes.rows().front().needed("printed_change"),
          .as_meant = changes.rows().front().needed("defect"),
          .required = 0.0};
}

/// Circles of 30 km and 330 km around the centre of the Earth lie inside of it.
Misprint altitudes(const Problem& problem) {
  const double earth = problem.parameter("earth_radius");
  const auto outside = [&](double centre) {
    double count = 0.0;
    for (const char* const altitude : {"initial_altitude", "target_altitude"})
      count += centre + problem.parameter(altitude) > earth ? 1.0 : 0.0;
    return count;
  };
  return {.problem = problem.name(),
          .name = "altitudes",
          .where = "section 4.2.1, Results",
          .printed = "r^0 = 30 km and r^T = 330 km are radii",
          .meant = "both are altitudes: the radii are greater by the radius of the Earth",
          .quantity = "number of orbits outside the Earth",
          .as_printed = outside(0.0),
          .as_meant = outside(earth),
          .required = 2.0};
}

/// φ is a coordinate of the trajectory, from φ(0) = 0 on; T is d periods of the ellipse that touches both circles.
Misprint final_angle(const Problem& problem) {
  const double turn = 2.0 * std::numbers::pi;
  const BoundaryState end = problem.final_state();
  const double half_axis = 0.5 * (problem.initial_state().q[0] + end.q[0]);
  constexpr double printed_angle = 0.0;
  return {.problem = problem.name(),
          .name = "final_angle",
          .where = "section 4.2.1, Boundary Conditions",
          .printed = "(r(T), phi(T)) = (r^T, 0)",
          .meant = "(r^T, 2 pi d) after d revolutions, which T contains",
          .quantity = "revolutions from phi(0) to phi(T), and T in periods of the ellipse between both circles",
          .as_printed = printed_angle / turn,
          .as_meant = end.q[1] / turn,
          .required = problem.horizon() / (turn * std::pow(half_axis, 1.5))};
}

/// Ω_L(∂/∂r, ∂/∂ṙ) = ∓L_ṙṙ for Ω_L = ±dΘ_L, and 𝔽L*Ω of the same vectors is ∂p_r/∂ṙ for Ω = -dΘ = dq∧dp.
Misprint signs_of_forms(const Problem& problem) {
  const BoundaryState first = problem.initial_state();
  LegendreTransform legendre{TracedProblem(problem)};
  const auto momentum = [&](double more) {
    return legendre.momentum(first.q, first.v + more * Eigen::Vector2d::Unit(0), 0.0)[0];
  };
  const ExpressionVector q = first.q.cast<Expression>();
  const ExpressionVector v = input_vector(0, 2);
  const Expression lagrangian = problem.lagrangian({q, v, 0.0, {}});
  const double second_derivative =
      replay<double>(Schedule(gradient(gradient(lagrangian, v)[0], v)), std::span<const double>(first.v.data(), 2))
          .front();
  return {.problem = problem.name(),
          .name = "signs_of_forms",
          .where = "section 2.1, Omega_L and Omega",
          .printed = "Omega_L = d Theta_L and Omega = -d Theta",
          .meant = "both with the same sign, so that FL^* Omega = Omega_L",
          .quantity = "Omega_L(d/dr, d/dr'), and FL^* Omega of these vectors",
          .as_printed = -second_derivative,
          .as_meant = second_derivative,
          .required = momentum(1.0) - momentum(0.0)};
}

/// max_u H(x(t), u, λ(t)) - H(x*(t), u*(t), λ(t)) of the double integrator, H = -½u² + λ_q v + λ_p u, where x(t) is
/// another trajectory.
Misprint trajectory_of_the_maximum() {
  const auto problem = make_problem("double_integrator");
  const std::optional<OptimalPoint> at = problem->optimum(0.25);
  if (!at) throw Error("the double integrator has no closed form with these parameters");
  const double lambda_q = -at->psi_q[0];
  const double lambda_p = -at->psi_p[0];
  const auto hamiltonian = [&](double v, double u) { return -0.5 * u * u + lambda_q * v + lambda_p * u; };
  const double v = at->motion.v[0];
  const double optimal = hamiltonian(v, at->motion.u[0]);
  constexpr double moved = 1.0;
  return {.problem = problem->name(),
          .name = "trajectory_of_the_maximum",
          .where = "th:pontryagin",
          .printed = "H(x*, u*, lambda) = max_u H(x(t), u, lambda), and lambda solves an initial value problem",
          .meant = "the maximum is taken at x*(t), and lambda, given at T, solves a final value problem",
          .quantity = "max_u H - H(x*, u*, lambda) where another trajectory is faster by 1",
          .as_printed = hamiltonian(v + moved, lambda_p) - optimal,
          .as_meant = hamiltonian(v, lambda_p) - optimal,
          .required = 0.0};
}

/// q_k^ν, ν = 0 .. s, of N intervals, less those that q_k^s = q_{k+1}^0 identifies, where both are among them.
Misprint index_of_shared_configurations(const Problem& problem) {
  constexpr Eigen::Index intervals = 16;
  const Tableau tableau = make_tableau("gauss", 1);
  const Transcription program(problem, *make_element("dmoc"), tableau, Grid::uniform(intervals));
  const auto unknowns = [&](Eigen::Index first, Eigen::Index last) {
    Eigen::Index count = intervals * (tableau.stages() + 1);
    for (Eigen::Index k = first; k <= last; ++k) count -= k + 1 < intervals ? 1 : 0;
    return static_cast<double>(count * problem.configuration_size());
  };
  return {.problem = problem.name(),
          .name = "index_of_shared_configurations",
          .where = "rem:savings, 1",
          .printed = "q_k^s = q_k+1^0, k = 1 .. N - 1",
          .meant = "k = 0 .. N - 2",
          .quantity = "unknown configurations of DMOC's program, N = 16, s = 1",
          .as_printed = unknowns(1, intervals - 1),
          .as_meant = unknowns(0, intervals - 2),
          .required = static_cast<double>(program.variable_count()) -
                      static_cast<double>(intervals * tableau.stages() * problem.control_size())};
}

const Columns<Misprint> columns{
    {"problem", "", "name of the problem", &Misprint::problem, in_key},
    {"misprint", "", "short name of the statement", &Misprint::name, in_key},
    {"where", "", "place in the paper", &Misprint::where},
    {"printed", "", "the printed statement", &Misprint::printed},
    {"meant", "", "the intended statement", &Misprint::meant},
    {"quantity", "", "quantity that distinguishes the two statements", &Misprint::quantity},
    {"value_as_printed", "", "value of the quantity for the printed statement", &Misprint::as_printed},
    {"value_as_meant", "", "value of the quantity for the intended statement", &Misprint::as_meant},
    {"required_value", "", "required value of the quantity", &Misprint::required},
};

int evaluate_misprints(CommandLine& line) {
  TableRun run("misprints", line);
  const std::shared_ptr<const Problem> orbit = make_problem("orbital_transfer");
  StartProvider starts({}, TableRun::solver_options());
  const Trajectory motion =
      starts.solve({.problem = orbit, .method = "dmoc", .solver = "ipopt", .grid = Grid::uniform(128)});
  std::vector<Misprint> misprints{potential_without_sine(),
                                  swapped_momenta(*orbit, motion),
                                  mayer_gradient(*orbit, motion),
                                  transversality(starts),
                                  saddle_point(),
                                  trajectory_of_the_maximum(),
                                  final_momentum(*orbit, motion),
                                  figure_of_iterations(),
                                  lagrangian_form(orbit),
                                  signs_of_forms(*orbit),
                                  index_of_shared_configurations(*orbit),
                                  altitudes(*orbit),
                                  final_angle(*orbit)};
  std::ranges::copy(misprints_of_the_lemma(*orbit), std::back_inserter(misprints));
  run.add("misprints", columns, misprints);
  return run.write();
}

int run(int argc, char** argv) {
  return run_program("misprints",
                     "Evaluates each misprinted formula of the paper as printed and as corrected (misprints.csv).",
                     argc, argv, evaluate_misprints);
}

}  // namespace dmocbench::misprints_program
