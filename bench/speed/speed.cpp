// Times of exact derivatives per interval: the tape, the assembled program, formulas written by hand, a replay number
// by number, ADOL-C; and the peak of the machine.
#include "bench/speed/benchmark_program.hpp"
#include "bench/speed/interval_benchmark.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

int run_speed(int argc, char** argv) {
  FormulasOfPaper paper;
  const BenchmarkProgram program{
      .name = "speed",
      .description = "Measures times of exact derivatives per interval.",
      // Without flags it takes a minute: several stages and the chains of links are left out.
      .default_filter = "-gauss_[2-9]|link_chain",
      .register_benchmarks = [&paper] {
        for (const std::string& problem : paper_problem_names()) {
          paper.push_back(std::make_unique<BenchmarkedFormulas>(Formulas{.problem = problem}));
        }
        register_expression_benchmarks(paper);
        register_program_benchmarks();
        register_hand_benchmarks(paper);
#ifdef DMOCBENCH_SPEED_ADOLC
        register_adolc_benchmarks(paper);
#endif
        register_machine_benchmarks();
      }};
  return program.run(argc, argv);
}

}  // namespace dmocbench::speed

int main(int argc, char** argv) { return dmocbench::speed::run_speed(argc, argv); }
