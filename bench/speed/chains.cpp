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
#include "bench/speed/measured_page.hpp"
#include "bench/summary/ratio_interval.hpp"
#include "methods/diagnostics/convergence_order.hpp"
#include "methods/error.hpp"
#include "methods/numerics/median.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/solvers/kkt/intervals/interval_kkt.hpp"
#include "methods/transcription/start.hpp"
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

/// The chain at its guess: what an iteration of `interior_point` evaluates, and the system that it then eliminates. A
/// shift makes the Hessian positive definite, as the solver does where it is not.
class Chain {
 public:
  explicit Chain(int links) : links_(links), problem_(make_problem("link_chain")) {
    problem_->set_parameter("links", links);
    make_program();
    if (links > most_iterated) return;
    primal_ = sample(*program_, guessed_motion(*problem_));
    const auto constraints = static_cast<Eigen::Index>(program_->constraint_count());
    multipliers_ = Eigen::VectorXd::Constant(constraints, small_multiplier);
    hessian_.resize(static_cast<Eigen::Index>(program_->hessian_structure().size()));
    jacobian_.resize(static_cast<Eigen::Index>(program_->jacobian_structure().size()));
    gradient_.resize(primal_.size());
    residuals_.resize(constraints);
    shift_ = Eigen::VectorXd::Constant(primal_.size(), large_shift);
    step_.resize(primal_.size());
    step_of_multipliers_.resize(constraints);
    auto made = kkt::IntervalKkt::make(*program_);
    if (!made) throw Error(made.error());
    kkt_ = std::move(*made);
  }

  /// A round: the program is made, and iterations follow until the time of a round is over.
  void measure() {
    if (!setup_seconds_.empty()) make_again();
    setup_seconds_.push_back(last_setup_);
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
    const LocalFunctions& functions = program_->functions();
    row.set("lagrangian_operations", functions.lagrangian.operation_count());
    row.set("hessian_operations", functions.hessian.schedule.operation_count());
    set_interval(row, "setup_seconds", setup_seconds_);
    if (evaluation_.empty()) return row;
    row.set("evaluation_ns", median(evaluation_));
    row.set("elimination_ns", median(elimination_));
    set_interval(row, "iteration_ns", iteration_);
    return row;
  }

 private:
  static constexpr double small_multiplier = 0.01;
  static constexpr double large_shift = 1e4;

  static void set_interval(Row& row, const std::string& column, const std::vector<double>& values) {
    const RatioInterval time = ratio_interval(values);
    row.set(column, median(values));
    row.set(column + "_lower", time.lower);
    row.set(column + "_upper", time.upper);
  }

  [[nodiscard]] std::unique_ptr<Transcription> transcribed() const {
    return std::make_unique<Transcription>(*problem_, *make_element("dmoc"), make_tableau("gauss", 1),
                                           Grid::uniform(intervals));
  }
  void make_program() {
    const Clock::time_point begin = Clock::now();
    program_ = transcribed();
    last_setup_ = seconds_since(begin);
  }
  void make_again() {
    const Clock::time_point begin = Clock::now();
    static_cast<void>(transcribed());
    last_setup_ = seconds_since(begin);
  }

  void evaluate() {
    program_->constraints(primal_, residuals_);
    program_->gradient(primal_, gradient_);
    program_->jacobian(primal_, jacobian_);
    program_->hessian(primal_, 1.0, multipliers_, hessian_);
  }

  void eliminate() {
    const kkt::FactorisationStatus status = kkt_->solve({hessian_, jacobian_, shift_, no_compliance_},
                                                        {gradient_, residuals_}, {step_, step_of_multipliers_});
    if (status != kkt::FactorisationStatus::solved) throw Error("the system of a chain is not eliminated");
  }

  int links_;
  std::unique_ptr<Problem> problem_;
  std::unique_ptr<Transcription> program_;
  std::unique_ptr<kkt::IntervalKkt> kkt_;
  Eigen::VectorXd primal_;
  Eigen::VectorXd multipliers_;
  Eigen::VectorXd hessian_;
  Eigen::VectorXd jacobian_;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd residuals_;
  Eigen::VectorXd shift_;
  Eigen::VectorXd no_compliance_;
  Eigen::VectorXd step_;
  Eigen::VectorXd step_of_multipliers_;
  double last_setup_ = 0.0;
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

/// What a chain was to stay below, and whether it does; a busy machine shows upper bounds.
std::string verdict_of(const Table& table, int links, const std::string& column, double target,
                       const std::string& words) {
  for (const Row& row : table.rows()) {
    if (row.needed("links") != links) continue;
    const double lower = row.number(column + "_lower", 0.0);
    const double upper = row.number(column + "_upper", 0.0);
    std::string verdict = "undecided";
    if (upper <= target) {
      verdict = "below";
    } else if (is_busy()) {
      verdict = "not judged on a busy machine";
    } else if (lower > target) {
      verdict = "above";
    }
    if (row.needed("rounds") < fewest_rounds) verdict = "too few rounds";
    return fmt::format("- {}, {} links: {:.3g} ({:.3g} to {:.3g}), {:.3g} wanted: {}\n", words, links,
                       row.needed(column), lower, upper, target, verdict);
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
  page += verdict_of(table, 10, "iteration_ns", 6000.0, "nanoseconds per interval and iteration");
  page += verdict_of(table, longest, "setup_seconds", 1.0, "seconds to make the program");
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
