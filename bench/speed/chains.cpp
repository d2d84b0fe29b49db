// How the cost of an iteration grows with the number of configurations: chains of 2 to 32 links, DMOC, N = 256.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/speed/benchmark_program.hpp"
#include "bench/speed/speed_tables.hpp"
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

/// The chain at its guess: what an iteration of `interior_point` evaluates, and the system that it then eliminates. A
/// shift makes the Hessian positive definite, as the solver does where it is not.
class Chain {
 public:
  explicit Chain(int links) : problem_(make_problem("link_chain")) {
    problem_->set_parameter("links", links);
    const Clock::time_point begin = Clock::now();
    program_ = std::make_unique<Transcription>(*problem_, *make_element("dmoc"), make_tableau("gauss", 1),
                                               Grid::uniform(intervals));
    setup_seconds_ = seconds_since(begin);
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

  [[nodiscard]] double setup_seconds() const { return setup_seconds_; }

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

 private:
  static constexpr double small_multiplier = 0.01;
  static constexpr double large_shift = 1e4;

  std::unique_ptr<Problem> problem_;
  std::unique_ptr<Transcription> program_;
  std::unique_ptr<kkt::IntervalKkt> kkt_;
  double setup_seconds_ = 0.0;
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
};

/// Every turn evaluates once and eliminates once. The manual time is that of both.
void run(benchmark::State& state, int links) {
  Chain chain(links);
  std::vector<double> of_evaluation;
  std::vector<double> of_elimination;
  for ([[maybe_unused]] auto turn : state) {
    const Clock::time_point begin = Clock::now();
    chain.evaluate();
    of_evaluation.push_back(seconds_since(begin));
    const Clock::time_point middle = Clock::now();
    chain.eliminate();
    of_elimination.push_back(seconds_since(middle));
    state.SetIterationTime(of_evaluation.back() + of_elimination.back());
  }
  const double evaluation = nanoseconds / intervals * median(of_evaluation);
  const double elimination = nanoseconds / intervals * median(of_elimination);
  state.SetLabel(fmt::format("problem=link_chain method=dmoc links={} intervals={}", links, intervals));
  state.counters["links"] = links;
  state.counters["setup_seconds"] = chain.setup_seconds();
  state.counters["evaluation_ns"] = evaluation;
  state.counters["elimination_ns"] = elimination;
  state.counters["iteration_ns"] = evaluation + elimination;
}

void register_chains() {
  for (const int links : {2, 3, 4, 6, 8, 10, 16, 32}) {
    add_benchmark(fmt::format("chain/{}", links), benchmark::kMicrosecond,
                  [links](benchmark::State& state) { run(state, links); });
  }
}

/// Medians over the repetitions, per interval; the exponent of n since the row before.
TablesBySuffix tables_of(const Benchmarks& benchmarks) {
  const std::vector<std::string> counters{"setup_seconds", "evaluation_ns", "elimination_ns", "iteration_ns"};
  std::map<int, Row> by_links;
  for (const auto& [name, benchmark] : benchmarks) {
    by_links[static_cast<int>(benchmark.median_of("links").value_or(0.0))] = row_of(benchmark, counters);
  }
  Table table({"problem", "method", "intervals", "links", "setup_seconds", "evaluation_ns", "elimination_ns",
               "iteration_ns", "exponent"});
  int links_before = 0;
  double time_before = 0.0;
  for (auto& [links, row] : by_links) {
    const double time = row.needed("iteration_ns");
    if (links_before > 0) {
      row.set("exponent", std::log(time / time_before) / std::log(static_cast<double>(links) / links_before));
    }
    links_before = links;
    time_before = time;
    table.append(std::move(row));
  }
  return {{"", table}};
}

}  // namespace

}  // namespace dmocbench::speed

int main(int argc, char** argv) {
  using namespace dmocbench::speed;  // NOLINT(google-build-using-namespace): the program's own
  const BenchmarkProgram program{.name = "chains",
                                 .description = "Chains of links: what an interval takes in an iteration, over n.",
                                 .csv = "write FILE, a row per chain",
                                 .default_filter = "chain",
                                 .register_benchmarks = register_chains,
                                 .tables = tables_of};
  return program.run({argv, static_cast<std::size_t>(argc)});
}
