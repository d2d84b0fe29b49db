// The growth of the cost of an iteration with the number of configurations: chains of links by DMOC; and the time in
// which the program of a chain is made. `page` turns the result into chains.md.
#include <memory>
#include <string>
#include <utility>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/speed/benchmark_program.hpp"
#include "bench/speed/guessed_program.hpp"
#include "methods/error.hpp"
#include "methods/kkt/intervals/interval_kkt.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

constexpr int intervals = 256;

GuessedProgram chain_of(int links) {
  const std::shared_ptr<Problem> problem = make_problem("link_chain");
  problem->set_parameter("links", links);
  return {problem, "dmoc", intervals};
}

/// The evaluations of an iteration of `interior_point` at the guess of a chain, and the system that it then eliminates.
/// A shift makes the Hessian positive definite, as the solver does where it is not.
class Iteration {
 public:
  explicit Iteration(const GuessedProgram& made)
      : program_(*made.program), start_(made.start), step_(start_.size()), gradient_(start_.size()) {
    constexpr double small_multiplier = 0.01;
    constexpr double large_shift = 1e4;
    const auto constraints = static_cast<Eigen::Index>(program_.constraint_count());
    multipliers_ = Eigen::VectorXd::Constant(constraints, small_multiplier);
    shift_ = Eigen::VectorXd::Constant(start_.size(), large_shift);
    hessian_.resize(static_cast<Eigen::Index>(program_.hessian_structure().size()));
    jacobian_.resize(static_cast<Eigen::Index>(program_.jacobian_structure().size()));
    residuals_.resize(constraints);
    step_of_multipliers_.resize(constraints);
    auto kkt = kkt::IntervalKkt::make(program_);
    if (!kkt) throw Error(kkt.error());
    kkt_ = std::move(*kkt);
    evaluate();
  }

  void evaluate() {
    program_.constraints(start_, residuals_);
    program_.gradient(start_, gradient_);
    program_.jacobian(start_, jacobian_);
    program_.hessian(start_, 1.0, multipliers_, hessian_);
  }

  void eliminate() {
    const kkt::FactorisationStatus status = kkt_->solve({hessian_, jacobian_, shift_, no_compliance_},
                                                        {gradient_, residuals_}, {step_, step_of_multipliers_});
    if (status != kkt::FactorisationStatus::solved) throw Error("the system of a chain is not eliminated");
  }

 private:
  Transcription& program_;
  Eigen::VectorXd start_;
  Eigen::VectorXd step_;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd multipliers_;
  Eigen::VectorXd shift_;
  Eigen::VectorXd no_compliance_;
  Eigen::VectorXd hessian_;
  Eigen::VectorXd jacobian_;
  Eigen::VectorXd residuals_;
  Eigen::VectorXd step_of_multipliers_;
  std::unique_ptr<kkt::IntervalKkt> kkt_;
};

/// Adds QUANTITY/LINKS, where `run` times that quantity of the chain.
void add(const std::string& quantity, int links, void (*run)(benchmark::State&, const GuessedProgram&)) {
  const auto run_or_tell = [=](benchmark::State& state) {
    try {
      const GuessedProgram made = chain_of(links);
      run(state, made);
      const LocalFunctions& functions = made.program->functions();
      state.SetLabel(fmt::format("quantity={} links={} intervals={}", quantity, links, intervals));
      state.counters["lagrangian_operations"] = static_cast<double>(functions.lagrangian.operation_count());
      state.counters["hessian_operations"] = static_cast<double>(functions.hessian.schedule.operation_count());
    } catch (const Error& error) {
      state.SkipWithError(error.what());
    }
  };
  benchmark::RegisterBenchmark(fmt::format("{}/{}", quantity, links).c_str(), run_or_tell)
      ->Unit(benchmark::kMicrosecond);
}

template <void (Iteration::*part)()>
void run_part(benchmark::State& state, const GuessedProgram& made) {
  Iteration iteration(made);
  for ([[maybe_unused]] auto turn : state) (iteration.*part)();
}

void run_making(benchmark::State& state, const GuessedProgram& made) {
  const auto links = static_cast<int>(made.problem->configuration_size());
  for ([[maybe_unused]] auto turn : state) benchmark::DoNotOptimize(chain_of(links));
}

void register_chains() {
  constexpr int most_iterated = 32;  // links; of longer chains only making the program is timed
  for (const int links : {2, 3, 4, 6, 8, 10, 16, 32, 64}) {
    add("making", links, run_making);
    if (links > most_iterated) continue;
    add("evaluation", links, run_part<&Iteration::evaluate>);
    add("elimination", links, run_part<&Iteration::eliminate>);
  }
}

}  // namespace

int run_chains(int argc, char** argv) {
  const BenchmarkProgram program{.name = "chains",
                                 .description = "Time of an iteration with chains of links, over their number.",
                                 .default_filter = ".",
                                 .register_benchmarks = register_chains};
  return program.run(argc, argv);
}

}  // namespace dmocbench::speed

int main(int argc, char** argv) { return dmocbench::speed::run_chains(argc, argv); }
