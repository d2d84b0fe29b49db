// DMOC and Hamiltonian collocation with the same tableau describe the same discrete solutions (th:equi): both are
// solved separately from the common start and compared, with tangent-space collocation as the control. The costates of
// each are put into the adjoint scheme (th:orderapp).
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bench/run/experiment.hpp"
#include "bench/tables/fitted_orders.hpp"
#include "methods/diagnostics/adjoint_scheme.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/control_lagrangian.hpp"
#include "methods/error.hpp"
#include "methods/judgement/kkt_residual.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/elements/galerkin_element.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench::equivalence_program {

/// Largest difference of two tables relative to the largest entry of the second.
double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / b.lpNorm<Eigen::Infinity>();
}

/// The violation of a method's constraints by a trajectory on the same grid, and how much of it may be rounding.
struct ForeignViolation {
  double violation = 0.0;
  double rounding = 0.0;
};

ForeignViolation violation_in(Case other, const std::string& method, const Trajectory& trajectory) {
  other.method = method;
  other.derivatives = "tape";
  other.form = CostForm::bolza;
  const auto program = other.transcribe();
  // The floor is a momentum's; collocation has constraints of force, differences of momenta divided by the step,
  // and its last stage rate is such a difference divided by its weight.
  const bool has_constraints_of_force = program->node_state() != NodeState::configuration;
  const double last_weight = program->tableau().b[program->tableau().stages() - 1];
  const Eigen::VectorXd embedded = embed(*other.problem, *program, trajectory);
  const double divisor = has_constraints_of_force ? last_weight * program->steps(embedded).minCoeff() : 1.0;
  return {.violation = constraint_violation(*program, embedded),
          .rounding = program->rounding_floors().largest / divisor};
}

/// The largest relative difference of some tables of two trajectories; empty if one lacks them.
template <class... Tables>
std::optional<double> difference(const Trajectory& a, const Trajectory& b, Tables... tables) {
  const bool both_have = (((a.*tables).size() > 0 && (b.*tables).size() > 0) && ...);
  if (!both_have) return {};
  return std::max({relative_difference(a.*tables, b.*tables)...});
}

struct Measured {
  std::optional<double> configuration;  // the differences from DMOC's answer on the same grid
  std::optional<double> momentum;
  std::optional<double> control;
  std::optional<double> costate;
  std::optional<double> stage_costate;
  std::optional<double> objective;
  std::optional<double> horizon;
  std::optional<ForeignViolation> in_dmoc;  // this method's answer in DMOC's constraints
  std::optional<ForeignViolation> of_dmoc;  // DMOC's answer in this method's constraints
  std::optional<double> adjoint_residual;
  std::optional<double> plain_residual;
  std::optional<double> forced_form_residual;
  std::optional<double> acceleration_form_residual;
  std::optional<double> galerkin_form_difference;
  std::optional<double> straight_form_difference;
  std::optional<double> costate_momentum_spread;
  std::optional<int> polish_steps;
};

Case by_dmoc(Case the_case) {
  the_case.method = "dmoc";
  return the_case;
}

/// What the compared rows of a method show; empty without rows.
std::string finding_on(const Selection& rows) {
  if (rows.empty()) return "";
  const std::size_t equal = rows.where(has_solution_of_dmoc).size();
  return fmt::format(
      "equivalence: {} and dmoc have {} solutions: in {} of {}, each satisfies the other method's equations to "
      "round-off; the largest relative difference of q is {:.0e}",
      rows.front().text("method"),
      equal == rows.size() ? "equal"
      : equal == 0         ? "different"
                           : "partly equal",
      equal, counted(rows.size(), "comparison"), rows.max("configuration_difference"));
}

class Equivalence final : public ExperimentOf<Measured> {
 public:
  Equivalence()
      : ExperimentOf({.name = "equivalence",
                      .description =
                          "Solves with every method separately and compares the solutions with DMOC's on the same "
                          "grid. The table has the largest differences relative to the largest value of each "
                          "quantity, the residuals of each solution in the constraints of the other method, and the "
                          "residuals of the costates in the adjoint Runge-Kutta scheme. NAME_slopes.csv has the "
                          "orders of the differences of tangent-space collocation.",
                      .options = {.intervals = "16:1024"},
                      .further_files = {"_slopes.csv"},
                      .polishes = true}) {}
  [[nodiscard]] Columns<Measured> columns() const override {
    constexpr auto in_dmoc = &Measured::in_dmoc;
    constexpr auto of_dmoc = &Measured::of_dmoc;
    return {
        {"configuration_difference", "", "largest relative difference of q from DMOC", &Measured::configuration},
        {"momentum_difference", "", "largest relative difference of p from DMOC", &Measured::momentum},
        {"control_difference", "", "largest relative difference of the stage controls from DMOC", &Measured::control},
        {"costate_difference", "", "largest relative difference of the costates from DMOC", &Measured::costate},
        {"objective_difference", "", "relative difference of the cost from DMOC", &Measured::objective},
        {"violation_in_rows_of_dmoc", "", "residual of this solution in DMOC's constraints",
         from(in_dmoc, &ForeignViolation::violation)},
        {"rounding_in_rows_of_dmoc", "", "bound on the round-off of the previous column",
         from(in_dmoc, &ForeignViolation::rounding)},
        {"violation_of_dmoc_here", "", "residual of DMOC's solution in this method's constraints",
         from(of_dmoc, &ForeignViolation::violation)},
        {"rounding_here", "", "bound on the round-off of the previous column",
         from(of_dmoc, &ForeignViolation::rounding)},
        {"stage_costate_difference", "", "largest relative difference of the stage costates from DMOC",
         &Measured::stage_costate},
        {"adjoint_residual", "", "residual of the costates in the adjoint scheme", &Measured::adjoint_residual},
        {"adjoint_residual_by_plain_coefficients", "", "adjoint residual without exchanging A and its conjugate",
         &Measured::plain_residual},
        {"costate_momentum_spread", "", "relative change of the momentum of the costates along the trajectory",
         &Measured::costate_momentum_spread},
        {"polish_steps", "", "number of Newton steps after the solve", &Measured::polish_steps},
        {"horizon_difference", "", "relative difference of the horizon from DMOC", &Measured::horizon},
        {"forced_form_residual", "",
         "residual in the discrete Euler-Lagrange equations of the control Lagrangian C + xi F + xi' L_v, F = L_q + f",
         &Measured::forced_form_residual},
        {"acceleration_form_residual", "",
         "residual in the discrete Euler-Lagrange equations of C + xi q'' + xi' q', with q'' a function of (q, q', u)",
         &Measured::acceleration_form_residual},
        {"galerkin_form_difference", "",
         "relative difference of the program's Lagrangian, at the start and with the solution's multipliers, from the "
         "sum of h b_i (C + xi F + xi' L_v), with xi of the degree of q",
         &Measured::galerkin_form_difference},
        {"straight_form_difference", "", "the same relative difference with xi linear in time on every interval",
         &Measured::straight_form_difference},
    };
  }
  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    if (std::ranges::count(chosen, "dmoc", &Case::method) == 0)
      throw Error("equivalence compares with dmoc; add dmoc to --method");
    std::vector<Case> cases = chosen;
    for (Case& the_case : cases) the_case.shares = by_dmoc(the_case).label();
    return cases;
  }

  void measure(SolvedCase& solved, Measured& measured) override {
    measured.polish_steps = solved.polish_steps;
    if (!solved.trajectory || !is_discrete_optimum(solved)) return;  // the theorem is about these
    const Case& here = solved.the_case;
    const Trajectory& trajectory = *solved.trajectory;
    if (has_galerkin_form(*solved.program)) {
      const auto difference_of = [&](MultiplierPath path) {
        return galerkin_form(*solved.program, solved.start, solved.solution.multipliers, path).difference();
      };
      measured.galerkin_form_difference = difference_of(MultiplierPath::polynomial);
      measured.straight_form_difference = difference_of(MultiplierPath::straight);
    }
    const bool is_galerkin = here.method.starts_with(galerkin_family);
    if (trajectory.has_costates() && TracedProblem(*here.problem).has_symmetry())
      measured.costate_momentum_spread = costate_momentum(*here.problem, trajectory).spread;
    if (trajectory.has_stage_costates()) {
      // By the coefficients that the theorem predicts, and by the state scheme's without exchanging the halves.
      const Tableau& tableau = trajectory.tableau;
      const auto residual = [&](const AdjointCoefficients& coefficients) {
        return adjoint_residual(*here.problem, trajectory, coefficients).largest();
      };
      measured.adjoint_residual = residual(adjoint_coefficients(tableau));
      measured.plain_residual = residual({.a_q = tableau.a, .a_p = tableau.a_conjugate});
      const bool has_control_lagrangian = here.problem->first_order_size() == 0 && trajectory.stages() == 1;
      if (has_control_lagrangian && trajectory.intervals() > 1) {
        const auto of_form = [&](ControlLagrangianForm form) {
          return control_lagrangian_residual(*here.problem, trajectory, form).largest();
        };
        measured.forced_form_residual = of_form(ControlLagrangianForm::forced_euler_lagrange);
        measured.acceleration_form_residual = of_form(ControlLagrangianForm::acceleration);
      }
    } else if (trajectory.has_costates() && !is_galerkin) {
      solved.note(
          "The adjoint scheme is not evaluated: with path constraints, integrals or first-order states, the stages "
          "have further multipliers.");
    }
    if (here.method == "dmoc") {
      answers_.emplace_back(here, trajectory);
      return;
    }
    if (is_galerkin) return;  // its stages are not DMOC's
    const Case partner = by_dmoc(here);
    const auto found = std::ranges::find_if(answers_, [&](const auto& answer) {
      return answer.first.same_curve(partner) && answer.first.grid.relative_times() == here.grid.relative_times();
    });
    if (found == answers_.end()) {
      solved.note("Not compared: DMOC was not solved on this grid, or its solution is on another branch.");
      return;
    }
    compare(here, trajectory, found->second, measured);
  }

  void finish(Table& table, FurtherOutput& output) override {
    output.write("_slopes.csv", fit_differences(table, "configuration_difference"));
    for (const Selection& rows : Selection(table).group_by({"method"})) {
      const std::string finding = finding_on(rows.with_number("violation_in_rows_of_dmoc"));
      if (!finding.empty()) output.summary.say(finding);
    }
  }

 private:
  static void compare(const Case& here, const Trajectory& answer, const Trajectory& dmoc, Measured& measured) {
    using T = Trajectory;
    const auto horizon = [](const Trajectory& any) { return any.node_times[any.intervals()]; };
    measured.configuration = difference(answer, dmoc, &T::q);
    measured.momentum = difference(answer, dmoc, &T::p);
    measured.control = difference(answer, dmoc, &T::stage_u);
    measured.costate = difference(answer, dmoc, &T::psi_q, &T::psi_p);
    measured.stage_costate = difference(answer, dmoc, &T::stage_psi_q, &T::stage_psi_p);
    measured.horizon = std::abs(horizon(answer) - horizon(dmoc)) / horizon(dmoc);
    measured.objective = std::abs(answer.cost - dmoc.cost) / std::abs(dmoc.cost);
    measured.in_dmoc = violation_in(here, "dmoc", answer);
    measured.of_dmoc = violation_in(here, here.method, dmoc);
  }

  std::vector<std::pair<Case, Trajectory>> answers_;  // of DMOC, which is the first method
};

int run(int argc, char** argv) { return run_experiment(Equivalence(), argc, argv); }

}  // namespace dmocbench::equivalence_program
