// DMOC and Hamiltonian collocation with the same tableau describe the same discrete solutions (th:equi): both are
// solved separately from the common start and compared, tangent-space collocation beside them as the control. The
// costates of each are put into the adjoint scheme (th:orderapp).
#include "bench/experiment/experiment.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/summary/fitted_orders.hpp"
#include "methods/diagnostics/adjoint_scheme.hpp"
#include "methods/error.hpp"
#include "methods/program/kkt_residual.hpp"
#include "methods/transcription/embedding.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

namespace {

/// Largest difference of two tables relative to the largest entry of the second.
double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / b.lpNorm<Eigen::Infinity>();
}

/// What `trajectory` leaves in the rows of another method on the same grid.
double foreign_violation(const Case& what, const std::string& other_method, const Trajectory& trajectory,
                         double& rounding) {
  Transcription other(*what.problem, *make_element(other_method), make_tableau(what.tableau, what.stages), what.grid);
  // The floor is that of a momentum; collocation has rows of force, differences of momenta divided by the step, and its
  // last slope is such a difference divided by its weight.
  const bool has_rows_of_force = other.layout().node_state() != NodeState::configuration;
  const double last_weight = other.tableau().b[other.tableau().stages() - 1];
  const Eigen::VectorXd embedded = embed(*what.problem, other, trajectory);
  rounding = other.rounding_floor() / (has_rows_of_force ? last_weight * other.steps(embedded).minCoeff() : 1.0);
  return constraint_violation(other, embedded);
}

class Equivalence final : public Experiment {
 public:
  [[nodiscard]] std::string name() const override { return "equivalence"; }
  [[nodiscard]] std::string description() const override {
    return "Solves every method separately and compares with DMOC on the same grid: largest differences relative to "
           "each "
           "quantity's largest value, what each answer leaves in the other's rows, and what costates leave in the "
           "adjoint "
           "Runge-Kutta scheme; slopes of the differences of tangent-space collocation (NAME_slopes.csv).";
  }
  [[nodiscard]] std::string default_intervals() const override { return "16:1024"; }
  [[nodiscard]] std::vector<std::string> own_columns() const override {
    return {"configuration_difference",
            "momentum_difference",
            "control_difference",
            "costate_difference",
            "objective_difference",
            "violation_in_rows_of_dmoc",
            "rounding_in_rows_of_dmoc",
            "violation_of_dmoc_here",
            "rounding_here",
            "stage_costate_difference",
            "adjoint_residual",
            "adjoint_residual_by_plain_coefficients",
            "polish_steps"};
  }
  [[nodiscard]] bool polishes() const override { return true; }
  void check(const std::vector<Case>& cases) override {
    for (const Case& what : cases) {
      if (what.method == "dmoc") return;
    }
    throw Error("equivalence compares with dmoc: add it to --method");
  }

  void complete(SolvedCase& solved) override {
    if (!solved.trajectory || !is_usable(solved.row)) return;
    if (solved.trajectory->has_costates()) {
      set_adjoint_residuals(*solved.what.problem, *solved.trajectory, solved.row);
    }
    if (solved.what.method == "dmoc") {
      answers_.push_back({solved.what, *solved.trajectory});
      return;
    }
    for (const Answer& dmoc : answers_) {
      const bool partner = dmoc.what.problem == solved.what.problem && dmoc.what.tableau == solved.what.tableau &&
                           dmoc.what.stages == solved.what.stages && dmoc.what.solver == solved.what.solver &&
                           dmoc.what.derivatives == solved.what.derivatives &&
                           dmoc.trajectory.node_times == solved.trajectory->node_times;
      if (partner) compare(dmoc.trajectory, *solved.trajectory, solved.what, solved.row);
    }
  }

  void finish(const Table& table, const std::filesystem::path& prefix, nlohmann::ordered_json& /*metadata*/) override {
    write_file(prefix.string() + "_slopes.csv", fit_differences(table, "configuration_difference").csv());
  }

 private:
  struct Answer {
    Case what;
    Trajectory trajectory;
  };

  /// By the coefficients that the theorem predicts, and by those of the state scheme without exchanging the halves.
  static void set_adjoint_residuals(const Problem& problem, const Trajectory& trajectory, Row& row) {
    const Tableau& tableau = trajectory.tableau;
    const AdjointCoefficients plain{.a_q = tableau.a, .a_p = tableau.a_conjugate};
    row.set("adjoint_residual", adjoint_residual(problem, trajectory, adjoint_coefficients(tableau)).largest());
    row.set("adjoint_residual_by_plain_coefficients", adjoint_residual(problem, trajectory, plain).largest());
  }

  static void compare(const Trajectory& dmoc, const Trajectory& here, const Case& what, Row& row) {
    row.set("configuration_difference", relative_difference(here.q, dmoc.q));
    row.set("momentum_difference", relative_difference(here.p, dmoc.p));
    row.set("control_difference", relative_difference(here.stage_u, dmoc.stage_u));
    if (here.has_costates() && dmoc.has_costates()) {
      row.set("costate_difference",
              std::max(relative_difference(here.psi_q, dmoc.psi_q), relative_difference(here.psi_p, dmoc.psi_p)));
      row.set("stage_costate_difference", std::max(relative_difference(here.stage_psi_q, dmoc.stage_psi_q),
                                                   relative_difference(here.stage_psi_p, dmoc.stage_psi_p)));
    }
    row.set("objective_difference", std::abs(here.cost - dmoc.cost) / std::abs(dmoc.cost));
    double rounding_there = 0.0;
    double rounding_here = 0.0;
    row.set("violation_in_rows_of_dmoc", foreign_violation(what, "dmoc", here, rounding_there));
    row.set("violation_of_dmoc_here", foreign_violation(what, what.method, dmoc, rounding_here));
    row.set("rounding_in_rows_of_dmoc", rounding_there);
    row.set("rounding_here", rounding_here);
  }

  std::vector<Answer> answers_;
};

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) {
  dmocbench::Equivalence experiment;
  return dmocbench::run_experiment(experiment, argc, argv);
}
