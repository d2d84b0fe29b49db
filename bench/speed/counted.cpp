// A dozen programs, solved for fixed numbers of iterations while callgrind counts instructions
// (`bench/speed/instructions`).
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <valgrind/callgrind.h>

#include "bench/run/build.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/error_sentences.hpp"
#include "bench/speed/guessed_program.hpp"
#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/program/counted_program.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/runtime/environment.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/solver.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// A program whose iterations are counted, with one parameter that is not its default.
struct CountedSolve {
  std::string problem;
  std::string method;
  int stages = 1;
  std::string parameter = {};
  double value = 0.0;

  /// "orbital_transfer/dmoc/1", the parameter after the problem.
  [[nodiscard]] std::string name() const {
    const std::string with = parameter.empty() ? "" : fmt::format("_{}_{}", parameter, value);
    return fmt::format("{}{}/{}/{}", problem, with, method, stages);
  }
};

constexpr int intervals = 128;
constexpr int iterations = 2;

// Every family of elements; kernels of known size and the generic ones; bounds, a free horizon; several stages.
const std::vector<CountedSolve>& counted_solves() {
  static const std::vector<CountedSolve> solves{
      {"orbital_transfer", "dmoc"},
      {"orbital_transfer", "hamiltonian"},
      {"orbital_transfer", "tangent"},
      {"two_link_manipulator", "dmoc"},
      {"two_link_manipulator", "hamiltonian"},
      {"two_link_manipulator", "tangent"},
      {"two_link_manipulator", "dmoc", 3},
      {"spherical_pendulum", "hamiltonian", 2},
      {"link_chain", "dmoc", 1, "links", 4.0},
      {"hang_glider", "dmoc"},
      {"planar_quadrotor", "hamiltonian", 1, "bounded", 1.0},
      {"double_oscillator", "dmoc"},
  };
  return solves;
}

/// A program whose Hessian takes more instructions than it should: `extra` for every interval.
class Slowed final : public ForwardingProgram {
 public:
  Slowed(NonlinearProgram& program, int extra) : ForwardingProgram(program), turns_(intervals * extra / 3) {}
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override {
    original().hessian(x, objective_factor, multipliers, values);
    for (int turn = 0; turn < turns_; ++turn) asm volatile("");  // add, compare, jump
  }

 private:
  int turns_;
};

/// Counts the first iterations from a point near the optimum, where each of them takes one linear system whatever
/// rounding does. The run before them, which is not counted, allocates all memory and chooses the order of elimination.
void count(const CountedSolve& solve, int extra) {
  const std::shared_ptr<Problem> problem = make_problem(solve.problem);
  if (!solve.parameter.empty()) problem->set_parameter(solve.parameter, solve.value);
  const GuessedProgram made(problem, solve.method, intervals, solve.stages);
  const Solution optimum = make_solver("interior_point")->solve(*made.program, made.start);
  if (!is_solved(optimum.status)) throw Error("{} is not solved: {}", solve.name(), optimum.message);
  const Eigen::VectorXd start = 0.95 * optimum.primal + 0.05 * made.start;

  int asked = 0;
  SolverOptions options;
  options.stop_requested = [&] {
    if (asked == 0) CALLGRIND_START_INSTRUMENTATION;
    if (asked == iterations) CALLGRIND_STOP_INSTRUMENTATION;
    return asked++ == iterations;
  };
  const auto solver = make_solver("interior_point", options);
  Slowed slowed(*made.program, extra);
  CountedProgram counted(extra > 0 ? static_cast<NonlinearProgram&>(slowed) : *made.program);
  const auto run = solver->prepare(counted);
  Solution solution;
  run->run(start, optimum.multipliers, std::nullopt, solution);
  CALLGRIND_ZERO_STATS;
  asked = 0;
  run->run(start, optimum.multipliers, std::nullopt, solution);
  const std::string of = fmt::format("{} {} {}", solve.name(), intervals, iterations);
  CALLGRIND_DUMP_STATS_AT(of.c_str());
  if (solution.status != Status::interrupted || solution.linear_systems != iterations) {
    throw Error(
        "{} took {} linear systems in {} iterations and ended with the status {}, but {} iterations of one "
        "system each were expected",
        solve.name(), solution.linear_systems.value_or(0), solution.major_iterations.value_or(0),
        name_of(solution.status), iterations);
  }
}

}  // namespace

}  // namespace dmocbench::speed

/// `counted NAME...` counts these programs, `counted --list` names all, `counted --compiler` names the compiler;
/// `counted --slowed INSTRUCTIONS NAME` counts a program with an added loop of this many instructions per interval.
int main(int argc, char** argv) {
  using namespace dmocbench;         // NOLINT(google-build-using-namespace): the program's own
  using namespace dmocbench::speed;  // NOLINT(google-build-using-namespace)
  try {
    check_environment();
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.empty()) throw Error("name at least one program; counted --list prints the names");
    set_thread_count(1);
    int extra = 0;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (arguments[i] == "--compiler") {
        fmt::print("{}\n", compiler());
      } else if (arguments[i] == "--list") {
        for (const CountedSolve& solve : counted_solves()) fmt::print("{}\n", solve.name());
      } else if (arguments[i] == "--slowed" && i + 1 < arguments.size()) {
        extra = parsed<int>(arguments[++i]).value_or(0);
        if (extra <= 0) throw Error("--slowed takes a positive whole number");
      } else {
        count(one_of(counted_solves(), &CountedSolve::name, arguments[i], "there is no program"), extra);
      }
    }
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "counted: {}\n", sentence_of(error));
    return 2;
  }
}
