// How the cost of an iteration grows with the number of configurations: chains of 2 to 32 links, DMOC, N = 256; and how
// long the program of a chain takes to make, up to 64 links.
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/experiment/command_line.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/speed/guessed_program.hpp"
#include "bench/speed/measured_page.hpp"
#include "methods/diagnostics/convergence_order.hpp"
#include "methods/error.hpp"
#include "methods/numerics/median.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/solvers/kkt/intervals/interval_kkt.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

constexpr int intervals = 256;
constexpr double nanoseconds = 1e9;  // of a second
constexpr int most_iterated = 32;    // links of a chain whose iterations are measured
constexpr int longest = 64;          // of which only the making of the program is

/// A share of a round: chains of few links iterate as often as this allows.
constexpr double seconds_of_a_round = 0.02;

/// Of an exponent: from here on the highest power shows.
constexpr int first_fitted = 8;

std::shared_ptr<const Problem> chain_of(int links) {
  auto problem = make_problem("link_chain");
  problem->set_parameter("links", links);
  return problem;
}

/// The chain at its guess: what an iteration of `interior_point` evaluates, and the system that it then eliminates. A
/// shift makes the Hessian positive definite, as the solver does where it is not.
class Chain {
 public:
  explicit Chain(int links) : links_(links), made_(chain_of(links), "dmoc", intervals) {
    if (links > most_iterated) return;
    const auto constraints = static_cast<Eigen::Index>(made_.program->constraint_count());
    multipliers_ = Eigen::VectorXd::Constant(constraints, small_multiplier);
    hessian_.resize(static_cast<Eigen::Index>(made_.program->hessian_structure().size()));
    jacobian_.resize(static_cast<Eigen::Index>(made_.program->jacobian_structure().size()));
    gradient_.resize(made_.start.size());
    residuals_.resize(constraints);
    shift_ = Eigen::VectorXd::Constant(made_.start.size(), large_shift);
    step_.resize(made_.start.size());
    step_of_multipliers_.resize(constraints);
    auto made = kkt::IntervalKkt::make(*made_.program);
    if (!made) throw Error(made.error());
    kkt_ = std::move(*made);
  }

  /// A round: the program is made, and iterations follow until the time of a round is over.
  void measure() {
    const bool is_first = setup_seconds_.empty();
    setup_seconds_.push_back(is_first ? made_.setup_seconds
                                      : GuessedProgram(made_.problem, "dmoc", intervals).setup_seconds);
    if (!kkt_) return;
    std::vector<double> of_evaluation;
    std::vector<double> of_elimination;
    const Clock::time_point begin = Clock::now();
    do {
      const Clock::time_point before = Clock::now();
      evaluate();
      of_evaluation.push_back(seconds_since(before));
      const Clock::time_point between = Clock::now();
      eliminate();
      of_elimination.push_back(seconds_since(between));
    } while (seconds_since(begin) < seconds_of_a_round);
    const double evaluation = nanoseconds / intervals * median(of_evaluation);
    const double elimination = nanoseconds / intervals * median(of_elimination);
    evaluation_.push_back(evaluation);
    elimination_.push_back(elimination);
    iteration_.push_back(evaluation + elimination);
  }

  [[nodiscard]] Row row() const {
    Row row;
    row.set("problem", "link_chain");
    row.set("method", "dmoc");
    row.set("intervals", intervals);
    row.set("links", links_);
    row.set("rounds", setup_seconds_.size());
    const LocalFunctions& functions = made_.program->functions();
    row.set("lagrangian_operations", functions.lagrangian.operation_count());
    row.set("hessian_operations", functions.hessian.schedule.operation_count());
    set_median(row, "setup_seconds", setup_seconds_);
    if (evaluation_.empty()) return row;
    row.set("evaluation_ns", median(evaluation_));
    row.set("elimination_ns", median(elimination_));
    set_median(row, "iteration_ns", iteration_);
    return row;
  }

 private:
  static constexpr double small_multiplier = 0.01;
  static constexpr double large_shift = 1e4;

  void evaluate() {
    Transcription& program = *made_.program;
    program.constraints(made_.start, residuals_);
    program.gradient(made_.start, gradient_);
    program.jacobian(made_.start, jacobian_);
    program.hessian(made_.start, 1.0, multipliers_, hessian_);
  }

  void eliminate() {
    const kkt::FactorisationStatus status = kkt_->solve({hessian_, jacobian_, shift_, no_compliance_},
                                                        {gradient_, residuals_}, {step_, step_of_multipliers_});
    if (status != kkt::FactorisationStatus::solved) throw Error("the system of a chain is not eliminated");
  }

  int links_;
  GuessedProgram made_;
  std::unique_ptr<kkt::IntervalKkt> kkt_;
  Eigen::VectorXd multipliers_;
  Eigen::VectorXd hessian_;
  Eigen::VectorXd jacobian_;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd residuals_;
  Eigen::VectorXd shift_;
  Eigen::VectorXd no_compliance_;
  Eigen::VectorXd step_;
  Eigen::VectorXd step_of_multipliers_;
  // A number per round.
  std::vector<double> setup_seconds_;
  std::vector<double> evaluation_;   // nanoseconds
  std::vector<double> elimination_;  // nanoseconds
  std::vector<double> iteration_;    // nanoseconds
};

/// The exponent of n in a column, as a sentence.
std::string exponent_of(const Table& table, const std::string& column, const std::string& words) {
  std::vector<GridError> points;
  for (const Row& row : table.rows()) {
    const double links = row.needed("links");
    const auto value = row.number(column);
    if (links >= first_fitted && value) points.push_back({links, *value});
  }
  const auto fitted = fit_order(points);
  if (!fitted) return fmt::format("- {}: too few chains to fit an exponent\n", words);
  return fmt::format("- {}: {:.2f} ± {:.2f}, over {} chains of {:.0f} to {:.0f} links\n", words, fitted->order,
                     fitted->standard_error, fitted->points, fitted->finest, fitted->coarsest);
}

/// Whether a chain stays below a target.
std::string judged_chain(const Table& table, int links, const std::string& column, double target,
                         const std::string& words) {
  for (const Row& row : table.rows()) {
    if (row.needed("links") != links) continue;
    const RatioInterval time{.ratio = row.needed(column),
                             .lower = row.needed(column + "_lower"),
                             .upper = row.needed(column + "_upper"),
                             .rounds = static_cast<std::size_t>(row.needed("rounds")),
                             .resampled = {}};
    return fmt::format("- {}, {} links: {:.3g} ({:.3g} to {:.3g}), {:.3g} wanted: {}\n", words, links, time.ratio,
                       time.lower, time.upper, target, verdict_on_target(time, target));
  }
  return "";
}

std::string page_of(const Table& table, const std::vector<std::string>& command) {
  std::string page = page_head("Chains of links: what an interval takes in an iteration", command);
  page += fmt::format(
      "`link_chain` by DMOC with the midpoint rule, N = {}. An iteration of `interior_point` evaluates residuals, "
      "gradient, Jacobian and Hessian and eliminates one system; times are per interval, medians over rounds in which "
      "every chain takes its turn, intervals of 99 % (bootstrap). Operations are those of the tape of an interval's "
      "Lagrangian ℓ = factor · cost + multipliers · rows, and of its Hessian. Making the program is tracing, "
      "differentiating and numbering.\n\n",
      intervals);
  page += page_table(table.rows(), {{"links", "links"},
                                    {"lagrangian_operations", "operations of ℓ", 9},
                                    {"hessian_operations", "of its Hessian", 9},
                                    {"evaluation_ns", "evaluation ns"},
                                    {"elimination_ns", "elimination ns"},
                                    {"iteration_ns", "both ns"},
                                    {"iteration_ns_lower", "from"},
                                    {"iteration_ns_upper", "to"},
                                    {"setup_seconds", "making s"},
                                    {"setup_seconds_lower", "from"},
                                    {"setup_seconds_upper", "to"}});
  page += "## Exponents of n, by least squares\n\n";
  page += exponent_of(table, "lagrangian_operations", "operations of ℓ");
  page += exponent_of(table, "hessian_operations", "operations of its Hessian");
  page += exponent_of(table, "evaluation_ns", "time of evaluation");
  page += exponent_of(table, "elimination_ns", "time of elimination");
  page += exponent_of(table, "iteration_ns", "time of both");
  page += exponent_of(table, "setup_seconds", "time of making the program");
  page += "\n## Targets\n\n";
  page += judged_chain(table, 10, "iteration_ns", 6000.0, "nanoseconds per interval and iteration");
  page += judged_chain(table, longest, "setup_seconds", 1.0, "seconds to make the program");
  return page;
}

int run_chains(CommandLine& line, const std::vector<std::string>& command) {
  std::filesystem::path out = "results";
  int rounds = 11;
  int most = longest;
  line.option("--out", out, "folder for speed_chains.csv and speed_chains.md");
  line.number("--rounds", rounds, 1, 1000, "how often every chain takes its turn");
  line.number("--links", most, 2, longest, "the longest chain");
  line.parse();
  static_cast<void>(is_busy());
  const OutputFolder folder(out);
  std::vector<std::unique_ptr<Chain>> chains;
  for (const int links : {2, 3, 4, 6, 8, 10, 16, 32, longest}) {
    if (links <= most) chains.push_back(std::make_unique<Chain>(links));
  }
  for (int round = 0; round < rounds; ++round) {
    for (const auto& chain : chains) chain->measure();
  }
  Table table({"problem", "method", "intervals", "links", "rounds", "lagrangian_operations", "hessian_operations",
               "evaluation_ns", "elimination_ns", "iteration_ns", "iteration_ns_lower", "iteration_ns_upper",
               "setup_seconds", "setup_seconds_lower", "setup_seconds_upper"});
  for (const auto& chain : chains) table.append(chain->row());
  write_file(out / "speed_chains.csv", table.csv());
  write_page(out / "speed_chains.md", page_of(table, command));
  return 0;
}

}  // namespace

}  // namespace dmocbench::speed

int main(int argc, char** argv) {
  return dmocbench::speed::run_page_program("chains",
                                            "Chains of links: what an interval takes in an iteration, over n.", argc,
                                            argv, dmocbench::speed::run_chains);
}
