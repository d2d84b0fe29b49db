// The value of exact derivatives compared with differences: section 4.1, "Automatic Differentiation", of the paper.
#include <algorithm>
#include <iterator>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "bench/experiments/derivatives/measured_derivatives.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/uniform_01.hpp"
#include "methods/error.hpp"
#include "methods/transcription/derivatives/back_ends.hpp"

namespace dmocbench::derivatives_program {

const std::string limited_memory = "limited_memory";

/// Of solves without exact second derivatives. A limit of time would let the load of the machine decide who solves;
/// exact derivatives take two or three iterations from the common start and a few dozen from the guess.
constexpr int most_iterations = 150;

/// Every unknown of a program costs dense differences an evaluation of all intervals, so that they take O(N²).
constexpr std::size_t most_dense_intervals = 64;

/// Multipliers around 1 of either sign, the same on every run.
Eigen::VectorXd fixed_multipliers(std::size_t constraints) {
  std::mt19937 engine(20090101U);
  return Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(constraints),
                                      [&] { return 2.0 * uniform_01(engine) - 1.0; });
}

struct Measured {
  bool is_exact = true;  ///< the Hessian; else limited_memory
  std::optional<double> jacobian_error;
  std::optional<double> hessian_error;
  std::optional<EvaluationTimes> seconds;
  std::optional<double> answer_difference;
};

/// A getter of the time of an evaluation in units of residual evaluations.
auto over_residual(double EvaluationTimes::*evaluation) {
  return [evaluation](const Measured& measured) {
    const bool is_wanted = evaluation != &EvaluationTimes::hessian || measured.is_exact;
    const std::optional<EvaluationTimes>& seconds = measured.seconds;
    return seconds && is_wanted ? std::optional((*seconds).*evaluation / seconds->residual) : std::nullopt;
  };
}

bool has_exact_hessian(const Case& the_case) { return the_case.variant.label.empty(); }

bool has_differences(const Case& the_case) { return the_case.derivatives.ends_with("differences"); }

class Derivatives final : public ExperimentOf<Measured> {
 public:
  Derivatives()
      : ExperimentOf(
            {.name = "derivatives",
             .description = "Compares derivative back ends: errors of Jacobian and Hessian relative to long double, "
                            "their times relative to one residual, and cost and accuracy of a solve. In column "
                            "hessian, exact is the back end's Hessian, limited_memory Ipopt's quasi-Newton Hessian, "
                            "which is not combined with central differences. Dense differences run up to N = 64. "
                            "Solves with differences or without an exact Hessian end after 150 iterations.",
             .options = {.solvers = {"ipopt"}, .derivatives = derivative_back_end_names(), .intervals = "16:1024"},
             .takes_turns = true,
             .compares_tolerances = true}) {}
  [[nodiscard]] Columns<Measured> columns() const override {
    return {
        {"hessian", "", "Hessian: exact or limited_memory",
         [](const Measured& measured) { return measured.is_exact ? "exact" : limited_memory; }, in_key},
        {"jacobian_error", "", "largest error of an entry, relative to the largest entry", &Measured::jacobian_error},
        {"hessian_error", "",
         "largest error of a Hessian entry, relative to the largest entry; empty if the solver uses none",
         &Measured::hessian_error},
        {"residual_seconds", "s", "time of one evaluation of all constraints (a residual)",
         from(&Measured::seconds, &EvaluationTimes::residual)},
        {"gradient_over_residual", "", "time of a gradient divided by the time of a residual",
         over_residual(&EvaluationTimes::gradient)},
        {"jacobian_over_residual", "", "time of a Jacobian divided by the time of a residual",
         over_residual(&EvaluationTimes::jacobian)},
        {"hessian_over_residual", "", "time of a Hessian divided by the time of a residual",
         over_residual(&EvaluationTimes::hessian)},
        {"answer_difference", "",
         "largest difference of q from the solution with the tape, relative to the largest value of q",
         &Measured::answer_difference},
    };
  }

  void add_options(CommandLine& line) override {
    line.list("--hessian", hessians_,
              "exact (by the back end) or limited_memory (Ipopt's quasi-Newton Hessian, not with finite_differences)");
  }

  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    const std::vector<std::string> hessians = chosen_of("--hessian", {"exact", limited_memory}, hessians_);
    std::vector<Case> within;
    std::ranges::copy_if(chosen, std::back_inserter(within), [](const Case& c) {
      return c.derivatives != "dense_differences" || c.grid.intervals() <= most_dense_intervals;
    });
    if (within.size() < chosen.size() && options().derivatives != derivative_back_end_names())
      remark(fmt::format("dense_differences is left out above N = {}", most_dense_intervals));
    std::vector<Case> cases = vary(within, [&](const Case& c) {
      const bool has_limited_memory = c.solver == "ipopt" && c.derivatives != "finite_differences";
      std::vector<std::string> labels;
      for (const std::string& hessian : hessians) {
        if (hessian == "exact") labels.emplace_back();
        if (hessian == limited_memory && has_limited_memory) labels.push_back(hessian);
      }
      return labels;
    });
    if (!cases.empty()) return cases;
    throw Error(
        "no case is left: --hessian limited_memory needs --solver ipopt and excludes finite_differences; "
        "dense_differences supports at most 64 intervals");
  }

  [[nodiscard]] SolvedCase solve(SolveTask task) override {
    const Case& the_case = task.the_case;
    if (!has_exact_hessian(the_case)) task.named_options.emplace("hessian_approximation", "limited-memory");
    if (has_differences(the_case) || !has_exact_hessian(the_case)) {
      task.options.most_iterations = std::min(task.options.most_iterations, most_iterations);
    }
    return Experiment::solve(std::move(task));
  }

  void measure(SolvedCase& solved, Measured& measured) override {
    const Case& the_case = solved.the_case;
    measured.is_exact = has_exact_hessian(the_case);
    if (solved.trajectory && the_case.derivatives == "tape" && measured.is_exact && is_usable(solved)) {
      answers_.emplace_back(the_case, solved.trajectory->q);
    }
    if (const Eigen::MatrixXd* const q = answer_by_tape(the_case); solved.trajectory && q != nullptr) {
      measured.answer_difference = (solved.trajectory->q - *q).lpNorm<Eigen::Infinity>() / q->lpNorm<Eigen::Infinity>();
    }
    if (!solved.program) return;
    evaluate(solved, measured);
  }

 private:
  /// Errors and times at the start of the solve.
  static void evaluate(const SolvedCase& solved, Measured& measured) {
    Transcription& program = *solved.program;
    const Eigen::VectorXd multipliers = fixed_multipliers(program.constraint_count());
    const DerivativeReference reference = reference_derivatives(program, solved.start, 1.0, multipliers);
    Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program.jacobian_structure().size()));
    program.jacobian(solved.start, jacobian);
    measured.jacobian_error = relative_error(jacobian, reference.jacobian);
    measured.seconds = measure_evaluations(program, solved.start, multipliers);
    if (!measured.is_exact) return;  // the solver was given no Hessian
    Eigen::VectorXd hessian(static_cast<Eigen::Index>(program.hessian_structure().size()));
    program.hessian(solved.start, 1.0, multipliers, hessian);
    measured.hessian_error = relative_error(hessian, reference.hessian);
  }

  /// q of the tape's answer to the same program, or null.
  [[nodiscard]] const Eigen::MatrixXd* answer_by_tape(Case the_case) const {
    the_case.derivatives = "tape";
    the_case.variant = {};
    const auto found = std::ranges::find_if(answers_, [&](const auto& answer) {
      return answer.first.same_curve(the_case) && answer.first.grid.relative_times() == the_case.grid.relative_times();
    });
    return found == answers_.end() ? nullptr : &found->second;
  }

  std::vector<std::string> hessians_{"exact", limited_memory};
  std::vector<std::pair<Case, Eigen::MatrixXd>> answers_;  // q by the tape, which is the first back end
};

int run(int argc, char** argv) { return run_experiment(Derivatives(), argc, argv); }

}  // namespace dmocbench::derivatives_program
