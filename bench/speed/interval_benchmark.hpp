#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/speed/benchmarked_formulas.hpp"
#include "methods/expression/tape.hpp"

namespace dmocbench::speed {

// The ways to evaluate the formulas of all intervals; names as in `IntervalBenchmark`.

/// tape/...: bare tapes, one by one ("residual", "jacobian", "hessian"), one after the other ("separate") and the three
/// made one tape ("fused"), on every instruction set there is. replay/...: the same schedules on one double after the
/// other.
void register_expression_benchmarks(const FormulasOfPaper& paper);

/// adolc/...: the Hessian by ADOL-C, one interval at a time ("hessian") or a block of them by one tape of ADOL-C
/// ("hessian_block"). Missing where ADOL-C is.
void register_adolc_benchmarks(const FormulasOfPaper& paper);

/// hand/...: formulas written by hand, see kernels.hpp, on every instruction set there is. Throws `Error` for a problem
/// without such formulas.
void register_hand_benchmarks(const FormulasOfPaper& paper);

/// program/...: the assembled program's evaluations, one by one and one after the other ("separate"), for every method,
/// Gauss with 1 to 3 stages, the paper's problems and chains of 2 to 8 links. A program is made when the first
/// benchmark requires it.
void register_program_benchmarks();

/// machine/arithmetic/SET: operations per second of fused multiplications and additions on registers (separate ones
/// where the set has no fused ones); machine/triad_LEVEL/SET: bytes per second of a_i = b_i + s c_i with arrays in that
/// level of memory.
void register_machine_benchmarks();

/// The subject of a benchmark. Its name is WAY/QUANTITY/PROBLEM[_LINKS][/METHOD/gauss_STAGES][/INSTRUCTION_SET].
struct IntervalBenchmark {
  std::string way;            ///< "tape", "program", "hand", ...
  std::string quantity = {};  ///< "residual", "jacobian", "hessian", "separate", ...
  Formulas formulas;
  bool names_method = false;         ///< where there are other methods and stages than the midpoint rule of DMOC
  std::string instruction_set = {};  ///< empty: the program's
};

/// Operations and memory traffic of an evaluation, per interval.
struct Work {
  std::size_t operations = 0;  ///< of the formulas
  double bytes = 0.0;          ///< of arrays read and written, each once; 0: not counted
};

/// The work of a schedule that writes that many numbers per interval; by default a column per output.
[[nodiscard]] Work work_of(const Schedule& schedule, const BenchmarkedFormulas& point,
                           std::optional<double> numbers_written = {});

/// A timed call: `evaluate` treats all intervals once.
struct Evaluation {
  std::function<void()> evaluate;
  Work work = {};
};

/// One after the other.
[[nodiscard]] Evaluation one_by_one(const std::vector<Evaluation>& evaluations);

/// Hands a benchmark to Google Benchmark; `make` is called at the beginning of every repetition.
void register_benchmark(const IntervalBenchmark& measured, std::function<Evaluation()> make);
void register_benchmark(const IntervalBenchmark& measured, const Evaluation& evaluation);

/// Writes the outputs of a schedule for all intervals, a column per output.
using ColumnWriter = std::function<void(std::span<double* const> outputs)>;
/// The same by a tape.
[[nodiscard]] ColumnWriter by_tape(const BenchmarkedFormulas& point, const Schedule& schedule, InstructionSet set);

/// An evaluation that writes the outputs of a schedule to columns of its own. Throws as `require_agreement`.
[[nodiscard]] Evaluation checked_evaluation(const BenchmarkedFormulas& point, const Schedule& schedule,
                                            const std::string& name, const ColumnWriter& write,
                                            double tolerance = 1e-10);

/// Hands residual, Jacobian and Hessian to Google Benchmark, evaluated one by one and one after the other ("separate").
/// `writer(i)` makes the evaluation of the i-th of `quantities`. Throws as `require_agreement`.
void register_quantities(IntervalBenchmark benchmark, const BenchmarkedFormulas& point,
                         const std::function<ColumnWriter(std::size_t i)>& writer, double tolerance = 1e-10);

/// Memory that begins with a cache line, eight numbers each.
struct alignas(64) CacheLine {
  std::array<double, 8> numbers{};
};

/// Throws `Error` unless `values`, the outputs of a schedule on an interval, are the tape's to `tolerance` times the
/// interval's largest: wrong results are not timed.
void require_agreement(const BenchmarkedFormulas& point, const Schedule& schedule, const std::string& name,
                       const std::function<std::vector<double>(std::size_t interval)>& values,
                       double tolerance = 1e-10);

}  // namespace dmocbench::speed
