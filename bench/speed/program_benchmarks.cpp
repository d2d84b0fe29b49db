#include <functional>

#include "bench/speed/benchmarks.hpp"

namespace dmocbench::speed {

namespace {

using Evaluation = std::function<void(Subject&, Eigen::VectorXd& result)>;

void register_evaluation(const std::string& quantity, Subject& subject, std::size_t operations, std::size_t size,
                         const Evaluation& evaluate) {
  const std::string name =
      "program/" + quantity + "/" + subject.problem() + "/" + std::string(name_of(preferred_instruction_set()));
  benchmark::RegisterBenchmark(name.c_str(), [&subject, operations, size, evaluate](benchmark::State& state) {
    Eigen::VectorXd result(static_cast<Eigen::Index>(size));
    for ([[maybe_unused]] auto turn : state) {
      evaluate(subject, result);
      benchmark::DoNotOptimize(result.data());
      benchmark::ClobberMemory();
    }
    count_intervals(state, operations);
  });
}

}  // namespace

void register_program_benchmarks(const Subjects& subjects) {
  for (const auto& subject : subjects) {
    Transcription& program = subject->program();
    const IntervalFunctions& functions = subject->functions();
    register_evaluation("residual", *subject, functions.rows.schedule.operation_count(), program.constraint_count(),
                        [](Subject& s, Eigen::VectorXd& result) { s.program().constraints(s.x(), result); });
    register_evaluation("jacobian", *subject, functions.jacobian.schedule.operation_count(),
                        program.jacobian_structure().size(),
                        [](Subject& s, Eigen::VectorXd& result) { s.program().jacobian(s.x(), result); });
    register_evaluation("hessian", *subject, functions.hessian.schedule.operation_count(),
                        program.hessian_structure().size(), [](Subject& s, Eigen::VectorXd& result) {
                          s.program().hessian(s.x(), Subject::objective_factor, s.multipliers(), result);
                        });
  }
}

}  // namespace dmocbench::speed
