// How the cost of an iteration grows with the number of configurations: chains of 2 to 32 links, DMOC, N = 256; and how
// long the program of a chain takes to make, up to 64 links.
#include <list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/speed/guessed_program.hpp"
#include "bench/speed/measured_page.hpp"
#include "methods/diagnostics/convergence_order.hpp"
#include "methods/error.hpp"
#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/numerics/median.hpp"
#include "methods/runtime/clock.hpp"
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

  [[nodiscard]] static Columns<Chain> columns() {
    const auto functions = [](const Chain& chain) { return &chain.made_.program->functions(); };
    return Columns<Chain>{
               {"problem", "", "name of the problem", [](const Chain&) { return "link_chain"; }},
               {"method", "", "family of elements", [](const Chain&) { return "dmoc"; }},
               {"intervals", "", "number of intervals N", [](const Chain&) { return intervals; }},
               {"links", "", "links of the chain, its number of configurations", &Chain::links_},
               {"rounds", "", "how often the chain took its turn", from(&Chain::setup_seconds_, &Rounds::size)},
               {"lagrangian_operations", "", "of the tape of an interval's Lagrangian",
                from(functions, [](const LocalFunctions& of) { return of.lagrangian.operation_count(); })},
               {"hessian_operations", "", "of the tape of its Hessian",
                from(functions, [](const LocalFunctions& of) { return of.hessian.schedule.operation_count(); })},
               {"evaluation_ns", "ns", "evaluating all derivatives, per interval", from(&Chain::evaluation_, median)},
               {"elimination_ns", "ns", "eliminating a system, per interval", from(&Chain::elimination_, median)}} +
           median_columns<Chain>("iteration_ns", "ns", "both", &Chain::iteration_) +
           median_columns<Chain>("setup_seconds", "s", "making the program", &Chain::setup_seconds_);
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

  using Rounds = std::vector<double>;

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
  Rounds setup_seconds_;
  Rounds evaluation_;   // nanoseconds
  Rounds elimination_;  // nanoseconds
  Rounds iteration_;    // nanoseconds
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
                     fitted->standard_error, fitted->points, fitted->first_abscissa, fitted->last_abscissa);
}

std::string page_of(const Table& table) {
  std::string page = fmt::format(
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
  return page;
}

MeasuredPage measure(int most_links, int rounds) {
  std::list<Chain> chains;
  for (const int links : {2, 3, 4, 6, 8, 10, 16, 32, longest}) {
    if (links <= most_links) chains.emplace_back(links);
  }
  for (int round = 0; round < rounds; ++round) {
    for (Chain& chain : chains) chain.measure();
  }
  const Table table = table_of(Chain::columns(), chains);
  return {"Chains of links: what an interval takes in an iteration", page_of(table), {{"", table}}};
}

}  // namespace

int run_chains(int argc, char** argv) {
  int most_links = longest;
  const PageProgram program{
      .name = "chains",
      .description = "Chains of links: what an interval takes in an iteration, over n.",
      .columns = describe(Chain::columns()),
      .options = [&](CommandLine& line) { line.number("--links", most_links, 2, longest, "the longest chain"); },
      .measure = [&](int rounds) { return measure(most_links, rounds); }};
  return program.run(argc, argv);
}

}  // namespace dmocbench::speed

int main(int argc, char** argv) { return dmocbench::speed::run_chains(argc, argv); }
