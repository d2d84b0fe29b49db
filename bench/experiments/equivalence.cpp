// DMOC and Hamiltonian collocation with the same tableau describe the same discrete solutions (th:equi): both are
// solved separately from the common start and compared, tangent-space collocation beside them as the control. The
// costates of each are put into the adjoint scheme (th:orderapp).
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "bench/run/experiment.hpp"
#include "bench/run/meanings.hpp"
#include "bench/tables/fitted_orders.hpp"
#include "methods/diagnostics/adjoint_scheme.hpp"
#include "methods/error.hpp"
#include "methods/judgement/kkt_residual.hpp"
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
  // The floor is that of a momentum; collocation has constraints of force, differences of momenta divided by the step,
  // and its last stage rate is such a difference divided by its weight.
  const bool has_constraints_of_force = program->layout().node_state() != NodeState::configuration;
  const double last_weight = program->tableau().b[program->tableau().stages() - 1];
  const Eigen::VectorXd embedded = embed(*other.problem, *program, trajectory);
  const double divisor = has_constraints_of_force ? last_weight * program->steps(embedded).minCoeff() : 1.0;
  return {.violation = constraint_violation(*program, embedded),
          .rounding = program->rounding_floors().largest / divisor};
}

class Equivalence final : public Experiment {
 public:
  Equivalence()
      : Experiment({.name = "equivalence",
                    .description =
                        "Solves every method separately and compares with DMOC on the same grid: largest differences "
                        "relative to each quantity's largest value, what each answer leaves in the other's rows, and "
                        "what costates leave in the adjoint Runge-Kutta scheme; slopes of the differences of "
                        "tangent-space collocation (NAME_slopes.csv).",
                    .options = {.intervals = "16:1024"},
                    .polishes = true}) {}
  [[nodiscard]] Columns<SolvedCase> columns() const override {
    using T = Trajectory;
    return {
        {"configuration_difference", "", "largest difference of q from DMOC's", difference(&T::q)},
        {"momentum_difference", "", "of p", difference(&T::p)},
        {"control_difference", "", "of the stage controls", difference(&T::stage_u)},
        {"costate_difference", "", "of psi", difference(&T::psi_q, &T::psi_p)},
        {"objective_difference", "", "of the cost", of(measured_.objective_difference)},
        {"violation_in_rows_of_dmoc", "", "what the answer leaves in DMOC's constraints",
         of(measured_.in_dmoc, &ForeignViolation::violation)},
        {"rounding_in_rows_of_dmoc", "", "what rounding may leave there",
         of(measured_.in_dmoc, &ForeignViolation::rounding)},
        {"violation_of_dmoc_here", "", "what DMOC's answer leaves in this method's constraints",
         of(measured_.of_dmoc, &ForeignViolation::violation)},
        {"rounding_here", "", "what rounding may leave there", of(measured_.of_dmoc, &ForeignViolation::rounding)},
        {"stage_costate_difference", "", "of Psi_i", difference(&T::stage_psi_q, &T::stage_psi_p)},
        {"adjoint_residual", "", "what the costates leave in the adjoint scheme", of(measured_.adjoint_residual)},
        {"adjoint_residual_by_plain_coefficients", "", "the same with A and its conjugate not exchanged",
         of(measured_.plain_residual)},
        {"polish_steps", "", "Newton steps behind the solver", from(&SolvedCase::polish_steps)},
        {"horizon_difference", "", "of T", of(measured_.horizon_difference)},
    };
  }
  void check(const std::vector<Case>& cases) override {
    const auto is_dmoc = [](const Case& the_case) { return the_case.method == "dmoc"; };
    if (!std::ranges::any_of(cases, is_dmoc)) throw Error("equivalence compares with dmoc: add it to --method");
  }

  /// DMOC's answer on the same grid.
  [[nodiscard]] std::string shared_by(const Case& the_case) const override {
    Case by_dmoc = the_case;
    by_dmoc.method = "dmoc";
    return by_dmoc.label();
  }

  void complete(SolvedCase& solved) override {
    measured_ = {};
    if (!solved.trajectory || !is_discrete_optimum(solved)) return;  // the theorem is about these
    const Case& here = solved.the_case;
    const Trajectory& trajectory = *solved.trajectory;
    if (trajectory.has_stage_costates()) {
      // By the coefficients that the theorem predicts, and by those of the state scheme without exchanging the halves.
      const Tableau& tableau = trajectory.tableau;
      const auto residual = [&](const AdjointCoefficients& coefficients) {
        return adjoint_residual(*here.problem, trajectory, coefficients).largest();
      };
      measured_.adjoint_residual = residual(adjoint_coefficients(tableau));
      measured_.plain_residual = residual({.a_q = tableau.a, .a_p = tableau.a_conjugate});
    } else if (trajectory.has_costates()) {
      solved.note(
          "Its stages have no costates to put into the adjoint scheme: constraints along the path have "
          "multipliers of their own there.");
    }
    if (here.method == "dmoc") {
      answers_.emplace_back(here, trajectory);
      return;
    }
    Case by_dmoc = here;
    by_dmoc.method = "dmoc";
    const auto is_partner = [&](const Case& dmoc) {
      return dmoc.same_curve(by_dmoc) && dmoc.grid.relative_times() == here.grid.relative_times();
    };
    for (const auto& [dmoc, answer] : answers_) {
      if (is_partner(dmoc)) measured_.dmoc = answer;
    }
    if (!measured_.dmoc) {
      solved.note("Not compared: DMOC was not solved on this grid, or on another branch.");
      return;
    }
    const auto horizon = [](const Trajectory& any) { return any.node_times[any.intervals()]; };
    measured_.horizon_difference = std::abs(horizon(trajectory) - horizon(*measured_.dmoc)) / horizon(*measured_.dmoc);
    measured_.objective_difference = std::abs(trajectory.cost - measured_.dmoc->cost) / std::abs(measured_.dmoc->cost);
    measured_.in_dmoc = violation_in(here, "dmoc", trajectory);
    measured_.of_dmoc = violation_in(here, here.method, *measured_.dmoc);
  }

  [[nodiscard]] std::vector<std::string> further_files() const override { return {"_slopes.csv"}; }
  void finish(const Table& table, const std::filesystem::path& prefix, nlohmann::ordered_json& metadata) override {
    write_table(prefix.string() + "_slopes.csv", fit_differences(table, "configuration_difference"), metadata);
  }

 private:
  /// A column's getter: the largest relative difference of some tables from those of DMOC's answer; none without them.
  template <class... Tables>
  [[nodiscard]] std::function<std::optional<double>(const SolvedCase&)> difference(Tables... tables) const {
    return [this, tables...](const SolvedCase& solved) -> std::optional<double> {
      const auto both_have = [&](auto table) {
        return measured_.dmoc && (*solved.trajectory.*table).size() > 0 && (*measured_.dmoc.*table).size() > 0;
      };
      if (!(both_have(tables) && ...)) return {};
      return std::max({relative_difference(*solved.trajectory.*tables, *measured_.dmoc.*tables)...});
    };
  }

  std::vector<std::pair<Case, Trajectory>> answers_;  // of DMOC
  struct {
    std::optional<Trajectory> dmoc;  // DMOC's answer on the same grid
    std::optional<double> objective_difference;
    std::optional<double> horizon_difference;
    std::optional<ForeignViolation> in_dmoc;  // this method's answer in DMOC's constraints
    std::optional<ForeignViolation> of_dmoc;  // DMOC's answer in this method's constraints
    std::optional<double> adjoint_residual;
    std::optional<double> plain_residual;
  } measured_;  // of the case that is completed
};

int run(int argc, char** argv) { return run_experiment(Equivalence(), argc, argv); }

}  // namespace dmocbench::equivalence_program
