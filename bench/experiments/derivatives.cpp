// What exact derivatives are worth beside differences: section 4.1, "Automatic Differentiation", of the paper.
#include <algorithm>
#include <optional>
#include <random>

#include "bench/experiments/measured_derivatives.hpp"
#include "bench/run/even_draws.hpp"
#include "bench/run/experiment.hpp"
#include "methods/error.hpp"

namespace dmocbench::derivatives_program {

const std::string limited_memory = "limited_memory";

/// Of solves without exact second derivatives. A limit of time would let the load of the machine decide who solves;
/// exact derivatives take two or three iterations from the common start and a few dozen from the guess.
constexpr int most_iterations = 150;

/// Multipliers around 1 of either sign, the same on every run.
Eigen::VectorXd fixed_multipliers(std::size_t constraints) {
  std::mt19937 engine(20090101U);
  return Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(constraints), [&] { return 2.0 * even(engine) - 1.0; });
}

class Derivatives final : public Experiment {
 public:
  Derivatives()
      : Experiment(
            {.name = "derivatives",
             .description =
                 "Back ends of derivatives: error of Jacobian and Hessian against long double, time relative to one "
                 "residual, and what a solve with them takes and reaches. Column hessian: exact is that of the back "
                 "end, limited_memory Ipopt's quasi-Newton one, with first derivatives by tape and by forward "
                 "differences. Solves but those by tape and adolc end after 150 iterations.",
             .options = {.derivatives = derivative_back_end_names(), .intervals = "16:1024"},
             .takes_turns = true,
             .compares_tolerances = true}) {}
  [[nodiscard]] Columns<SolvedCase> columns() const override {
    const auto over_residual = [this](double EvaluationTimes::*evaluation) {
      return [this, evaluation](const SolvedCase& solved) {
        const bool is_wanted = evaluation != &EvaluationTimes::hessian || solved.the_case.variant.empty();
        const std::optional<EvaluationTimes>& seconds = measured_.seconds;
        return seconds && is_wanted ? std::optional((*seconds).*evaluation / seconds->residual) : std::nullopt;
      };
    };
    return {
        {"hessian", "", "exact, or limited_memory",
         [](const SolvedCase& s) { return s.the_case.variant.empty() ? "exact" : s.the_case.variant; }},
        {"jacobian_error", "", "largest error of an entry, relative to the largest entry",
         of(measured_.jacobian_error)},
        {"hessian_error", "", "the same of the Hessian; empty where the solver was given none",
         of(measured_.hessian_error)},
        {"residual_seconds", "s", "one evaluation of all constraints",
         of(measured_.seconds, &EvaluationTimes::residual)},
        {"gradient_over_residual", "", "time of a gradient over that", over_residual(&EvaluationTimes::gradient)},
        {"jacobian_over_residual", "", "time of a Jacobian over that", over_residual(&EvaluationTimes::jacobian)},
        {"hessian_over_residual", "", "time of a Hessian over that", over_residual(&EvaluationTimes::hessian)},
        {"answer_difference", "", "largest difference of q from the tape's answer, relative to its largest value",
         of(measured_.answer_difference)},
    };
  }

  void add_options(CommandLine& line) override {
    line.list("--hessian", hessians_,
              "exact: that of the back end; limited_memory: Ipopt's quasi-Newton one, by tape and forward differences");
  }

  [[nodiscard]] std::vector<Case> variants(const std::vector<Case>& curve) const override {
    const Case& first = curve.front();
    const bool has_limited_memory =
        first.solver == "ipopt" && (first.derivatives == "tape" || first.derivatives == "forward_differences");
    std::vector<std::string> variants;
    for (const std::string& hessian : chosen_of("--hessian", {"exact", limited_memory}, hessians_)) {
      if (hessian == "exact") variants.emplace_back();
      if (hessian == limited_memory && has_limited_memory) variants.push_back(hessian);
    }
    return vary(curve, variants);
  }
  void check(const std::vector<Case>& cases) override {
    if (cases.empty()) {
      throw Error("--hessian limited_memory is for --solver ipopt with --derivatives tape or forward_differences");
    }
  }

  [[nodiscard]] std::unique_ptr<Solver> solver_for(const Case& the_case, SolverOptions options) override {
    NamedOptions named = named_options(this->options());
    if (the_case.variant == limited_memory) named.emplace("hessian_approximation", "limited-memory");
    const bool is_exact = the_case.derivatives == "tape" || the_case.derivatives == "adolc";
    if (!is_exact || !the_case.variant.empty()) {
      options.most_iterations = std::min(options.most_iterations, most_iterations);
    }
    return make_solver(the_case.solver, options, named);
  }

  void solved_once(const SolvedCase& solved) override {
    const Case& the_case = solved.the_case;
    if (!solved.trajectory || the_case.derivatives != "tape" || !the_case.variant.empty() || !is_usable(solved)) return;
    answers_.push_back(solved);
    answers_.back().program.reset();  // it is large
  }

  void complete(SolvedCase& solved) override {
    const Case& the_case = solved.the_case;
    measured_ = {};
    if (const SolvedCase* exact = partner_of(the_case); solved.trajectory && exact != nullptr && exact->trajectory) {
      const Eigen::MatrixXd& q = exact->trajectory->q;
      measured_.answer_difference = (solved.trajectory->q - q).lpNorm<Eigen::Infinity>() / q.lpNorm<Eigen::Infinity>();
    }
    if (!solved.program) return;
    try {
      evaluate(solved);
    } catch (const Error& failure) {
      solved.note(failure.what());
    }
  }

 private:
  /// Errors and times at the start of the solve.
  void evaluate(const SolvedCase& solved) {
    Transcription& program = *solved.program;
    const Eigen::VectorXd multipliers = fixed_multipliers(program.constraint_count());
    const DerivativeReference reference = reference_derivatives(program, solved.start, 1.0, multipliers);
    Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program.jacobian_structure().size()));
    program.jacobian(solved.start, jacobian);
    measured_.jacobian_error = relative_error(jacobian, reference.jacobian);
    measured_.seconds = measure_evaluations(program, solved.start, multipliers);
    if (!solved.the_case.variant.empty()) return;  // the solver was given no Hessian
    Eigen::VectorXd hessian(static_cast<Eigen::Index>(program.hessian_structure().size()));
    program.hessian(solved.start, 1.0, multipliers, hessian);
    measured_.hessian_error = relative_error(hessian, reference.hessian);
  }

  /// The tape's solve of the same program; null if there is none.
  [[nodiscard]] const SolvedCase* partner_of(const Case& the_case) const {
    Case by_tape = the_case;
    by_tape.derivatives = "tape";
    by_tape.variant = "";
    const auto found = std::ranges::find_if(answers_, [&](const SolvedCase& answer) {
      return answer.the_case.same_curve(by_tape) &&
             answer.the_case.grid.relative_times() == the_case.grid.relative_times();
    });
    return found == answers_.end() ? nullptr : &*found;
  }

  std::vector<std::string> hessians_{"exact", limited_memory};
  std::vector<SolvedCase> answers_;  // by the tape
  struct {
    std::optional<double> jacobian_error;
    std::optional<double> hessian_error;
    std::optional<EvaluationTimes> seconds;
    std::optional<double> answer_difference;
  } measured_;  // of the case that is completed
};

int run(int argc, char** argv) { return run_experiment(Derivatives(), argc, argv); }

}  // namespace dmocbench::derivatives_program
