// What exact derivatives are worth: section 4.1, "Automatic Differentiation", of the paper.
#include <algorithm>
#include <random>

#include "bench/derivatives/derivative_error.hpp"
#include "bench/derivatives/evaluation_times.hpp"
#include "bench/experiment/experiment.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

const std::string limited_memory = "limited_memory";

/// Solves without exact second derivatives may take this many times as long as the tape's on the same grid, but always
/// the shortest limit; what has not arrived by then is a row that says so. The last holds where there is no such solve.
constexpr double longer_than_tape = 15.0;
constexpr double shortest_limit = 0.2;  // [s]
constexpr double limit_without_tape = 0.5;
/// From the common start exact derivatives take two or three iterations.
constexpr int most_iterations = 150;

bool is_exact(const std::string& derivatives) { return derivatives == "tape" || derivatives == "adolc"; }

/// Multipliers around 1 of either sign, the same on every run.
Eigen::VectorXd fixed_multipliers(std::size_t rows) {
  std::mt19937 engine(20090101U);
  constexpr double half_range = 2147483648.0;
  return Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(rows),
                                      [&] { return static_cast<double>(engine()) / half_range - 1.0; });
}

class Derivatives final : public Experiment {
 public:
  [[nodiscard]] std::string name() const override { return "derivatives"; }
  [[nodiscard]] std::string description() const override {
    return "Back ends of derivatives: error of Jacobian and Hessian against long double, time relative to one "
           "residual, "
           "and what a solve with them takes and reaches. Column hessian: exact is that of the back end, "
           "limited_memory "
           "Ipopt's quasi-Newton one, with first derivatives by tape and by forward differences. Solves but those by "
           "tape and adolc end after 150 iterations, or 15 times the tape's time (at least 0.2 s).";
  }
  [[nodiscard]] std::string default_intervals() const override { return "16:1024"; }
  void set_defaults(ExperimentOptions& options) const override { options.derivatives = derivative_back_end_names(); }
  [[nodiscard]] std::vector<std::string> own_columns() const override {
    return {"hessian",
            "jacobian_error",
            "hessian_error",
            "residual_seconds",
            "gradient_over_residual",
            "jacobian_over_residual",
            "hessian_over_residual",
            "answer_difference"};
  }

  [[nodiscard]] std::vector<Case> variants(const std::vector<Case>& curve) const override {
    std::vector<Case> all = curve;
    const Case& first = curve.front();
    const bool has_limited_memory =
        first.solver == "ipopt" && (first.derivatives == "tape" || first.derivatives == "forward_differences");
    for (Case what : curve) {
      if (!has_limited_memory) break;
      what.variant = limited_memory;
      all.push_back(std::move(what));
    }
    return all;
  }

  [[nodiscard]] SolverOptions options_for(const Case& what, SolverOptions common) override {
    if (what.variant == limited_memory) common.passed_on.emplace("hessian_approximation", "limited-memory");
    if (is_exact(what.derivatives) && what.variant.empty()) return common;
    const Answer* exact = partner_of(what);
    common.most_iterations = std::min(common.most_iterations, most_iterations);
    common.most_seconds =
        exact != nullptr ? std::max(shortest_limit, longer_than_tape * exact->seconds) : limit_without_tape;
    return common;
  }

  void complete(SolvedCase& solved) override {
    const Case& what = solved.what;
    solved.row.set("hessian", what.variant.empty() ? "exact" : what.variant);
    if (solved.trajectory && what.derivatives == "tape" && what.variant.empty() && is_usable(solved.row)) {
      answers_.push_back({what, *solved.trajectory, solved.solution.seconds});
    }
    compare(solved);
    if (solved.start.size() > 0) evaluate(solved);
  }

 private:
  struct Answer {
    Case what;
    Trajectory trajectory;
    double seconds;
  };

  /// Errors and times at the start of the solve.
  static void evaluate(SolvedCase& solved) {
    const Case& what = solved.what;
    Transcription program(*what.problem, *make_element(what.method), make_tableau(what.tableau, what.stages), what.grid,
                          what.derivatives);
    const Eigen::VectorXd multipliers = fixed_multipliers(program.constraint_count());
    const DerivativeReference reference = reference_derivatives(program, solved.start, 1.0, multipliers);
    Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program.jacobian_structure().size()));
    program.jacobian(solved.start, jacobian);
    const EvaluationTimes seconds = measure_evaluations(program, solved.start, multipliers);
    Row& row = solved.row;
    row.set("jacobian_error", relative_error(jacobian, reference.jacobian));
    row.set("residual_seconds", seconds.residual);
    row.set("gradient_over_residual", seconds.gradient / seconds.residual);
    row.set("jacobian_over_residual", seconds.jacobian / seconds.residual);
    if (!what.variant.empty()) return;  // the solver was given no Hessian
    Eigen::VectorXd hessian(static_cast<Eigen::Index>(program.hessian_structure().size()));
    program.hessian(solved.start, 1.0, multipliers, hessian);
    row.set("hessian_error", relative_error(hessian, reference.hessian));
    row.set("hessian_over_residual", seconds.hessian / seconds.residual);
  }

  /// The tape's solve of the same program; null if there is none.
  [[nodiscard]] const Answer* partner_of(const Case& what) const {
    const auto found = std::find_if(answers_.begin(), answers_.end(), [&](const Answer& answer) {
      const Case& other = answer.what;
      return other.problem == what.problem && other.method == what.method && other.tableau == what.tableau &&
             other.stages == what.stages && other.solver == what.solver &&
             other.grid.relative_times() == what.grid.relative_times();
    });
    return found == answers_.end() ? nullptr : &*found;
  }

  /// Largest difference of q at the nodes from the tape's answer on the same grid, relative to its largest value.
  void compare(SolvedCase& solved) const {
    const Answer* exact = partner_of(solved.what);
    if (!solved.trajectory || exact == nullptr) return;
    const Eigen::MatrixXd& q = exact->trajectory.q;
    solved.row.set("answer_difference",
                   (solved.trajectory->q - q).lpNorm<Eigen::Infinity>() / q.lpNorm<Eigen::Infinity>());
  }

  std::vector<Answer> answers_;
};

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) {
  dmocbench::Derivatives experiment;
  return dmocbench::run_experiment(experiment, argc, argv);
}
