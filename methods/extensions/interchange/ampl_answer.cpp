#include "methods/extensions/interchange/ampl_answer.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "methods/error.hpp"
#include "methods/judgement/kkt_residual.hpp"
#include "methods/program/counted_program.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view spaces = " \t\r";
  const std::size_t first = text.find_first_not_of(spaces);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(spaces) - first + 1);
}

/// The lines of a file, one after the other.
class SolutionLines {
 public:
  explicit SolutionLines(std::string_view text) : rest_(text) {}

  /// The next line, which has to be whole.
  std::string_view next(std::string_view wanted) {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) {
      throw Error("the file ends at line {}, before {}; it is truncated or not a .sol file", number_ + 1, wanted);
    }
    const std::string_view line = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    ++number_;
    return line;
  }

  template <class Number>
  Number number(std::string_view wanted) {
    const std::string_view line = next(wanted);
    const auto value = parsed<Number>(line.starts_with('+') ? line.substr(1) : line);
    if (!value) throw Error("line {} must be a number ({}), but is \"{}\"", number_, wanted, shortened(line));
    return *value;
  }
  Eigen::Index count(std::string_view wanted) {
    const auto value = number<Eigen::Index>(wanted);
    if (value < 0) throw Error("line {} ({}) is negative", number_, wanted);
    return value;
  }
  [[nodiscard]] std::size_t line_number() const noexcept { return number_; }
  [[nodiscard]] std::size_t characters_left() const noexcept { return rest_.size(); }

  static std::string shortened(std::string_view line) {
    constexpr std::size_t longest = 30;
    std::string text(line.substr(0, longest));
    std::ranges::replace_if(
        text, [](unsigned char letter) { return std::isprint(letter) == 0; }, '?');
    return line.size() > longest ? text + " ..." : text;
  }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// The solver's message: all text before the line "Options".
std::string message_of(SolutionLines& lines) {
  std::string message;
  while (true) {
    const std::string_view line = lines.next("the line \"Options\"");
    if (line == "Options") return message;
    if (line.empty()) continue;
    message += message.empty() ? "" : " ";
    for (const char letter : line) message += std::isprint(static_cast<unsigned char>(letter)) != 0 ? letter : '?';
  }
}

/// Numbers that the .nl file's first line gave to the solver; with 3 as the second of them, a tolerance follows.
void skip_options(SolutionLines& lines) {
  constexpr Eigen::Index with_tolerance = 3;
  const Eigen::Index count = lines.count("the number of options");
  bool has_tolerance = false;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto option = lines.number<long long>("an option");
    if (i == 1) has_tolerance = option == with_tolerance;
  }
  if (has_tolerance) static_cast<void>(lines.number<double>("a tolerance"));
}

Eigen::VectorXd values(SolutionLines& lines, Eigen::Index count, std::string_view wanted) {
  if (std::cmp_greater(count, lines.characters_left())) {  // a line each
    throw Error("the file ends at line {}, before {}; it is truncated", lines.line_number(), wanted);
  }
  Eigen::VectorXd result(count);
  for (double& value : result) value = lines.number<double>(wanted);
  return result;
}

/// The number of values of a kind: all, or none.
Eigen::Index all_or_none(SolutionLines& lines, Eigen::Index size, std::string_view wanted) {
  const Eigen::Index count = lines.count(wanted);
  if (count == 0 || count == size) return count;
  throw Error("line {}: {} is {}, but must be 0 or {}", lines.line_number(), wanted, count, size);
}

/// "objno 0 CODE".
int code_of(std::string_view line) {
  constexpr std::string_view begin = "objno ";
  const std::size_t last = line.rfind(' ');
  const auto code = parsed<int>(line.substr(last == std::string_view::npos ? 0 : last + 1));
  if (!line.starts_with(begin) || last < begin.size() || !code) {
    throw Error(R"(the last line must be "objno 0 CODE", but reads "{}")", SolutionLines::shortened(line));
  }
  return *code;
}

}  // namespace

Status AmplSolution::status() const noexcept {
  constexpr int range = 100;
  switch (code / range) {
    case 0:
      return code < 0 ? Status::solver_error : Status::solved;
    case 1:
      return Status::acceptable;
    case 2:
      return Status::infeasible;
    case 3:
      return Status::diverged;
    case 4:
      return Status::iteration_limit;
    default:
      return Status::solver_error;
  }
}

AmplSolution read_ampl_solution(std::string_view text) {
  if (text.find('\0') != std::string_view::npos) {
    throw Error("the file is not a text file; write the .nl file in text form so that the solver writes text");
  }
  SolutionLines lines(text);
  AmplSolution solution;
  solution.message = message_of(lines);
  skip_options(lines);
  solution.constraint_count = lines.count("the number of constraints");
  const Eigen::Index duals = all_or_none(lines, solution.constraint_count, "the number of multipliers");
  solution.variable_count = lines.count("the number of variables");
  const Eigen::Index primals = all_or_none(lines, solution.variable_count, "the number of values");
  solution.multipliers = -values(lines, duals, "a multiplier");
  solution.primal = values(lines, primals, "a value");
  solution.code = code_of(lines.next("the line \"objno\""));
  return solution;
}

AmplAnswer::AmplAnswer(AmplSolution answer, SolverOptions options)
    : SolverWithoutMemory("ampl", "solution of another solver, from its .sol file", std::move(options)),
      answer_(std::move(answer)) {}

void AmplAnswer::require_fit(const NonlinearProgram& program) const {
  if (std::cmp_equal(answer_.variable_count, program.variable_count()) &&
      std::cmp_equal(answer_.constraint_count, program.constraint_count())) {
    return;
  }
  throw Error("the solution belongs to a program with {} variables and {} constraints, but this program has {} and {}",
              answer_.variable_count, answer_.constraint_count, program.variable_count(), program.constraint_count());
}

Solution AmplAnswer::run(CountedProgram& program, const Eigen::VectorXd& /*start*/) const {
  require_fit(program);
  Solution solution;
  solution.status = answer_.status();
  solution.primal = answer_.primal;
  solution.multipliers = answer_.multipliers;
  if (solution.primal.size() == 0) {  // there is no answer without a point
    if (is_solved(solution.status)) solution.status = Status::solver_error;
    solution.multipliers.resize(0);
  }
  if (solution.multipliers.size() > 0) {
    const Eigen::VectorXd other = -solution.multipliers;
    const auto stationarity = [&](const Eigen::VectorXd& multipliers) {
      return kkt_residual(program.uncounted(), solution.primal, multipliers).stationarity;
    };
    if (stationarity(other) < stationarity(solution.multipliers)) solution.multipliers = other;
  }
  return solution;
}

}  // namespace dmocbench
