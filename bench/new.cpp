// Writes the header of a problem to begin with, and the CMakeLists.txt that makes a library of it.
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "bench/run/command_line.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"

namespace dmocbench::new_program {

constexpr const char* header = R"(#pragma once

#include <numbers>

#include <dmocbench/problem.hpp>

namespace dmocbench {

/// Swing-up of a pendulum by a torque; replace the formulas with your own.
///
/// Use sin, cos, sqrt, exp, log and pow on expressions; where a formula has a kink, use smooth_abs, smooth_max, smooth_min
/// or smooth_if_else. Angles are in radians; solvers work best with sizes near 1.
class CLASS : public Problem {
 public:
  CLASS()
      : Problem({{.name = "length", .value = 1.0, .unit = "m", .meaning = "of the rod", .lower = 0.1, .upper = 10.0}}) {}

  [[nodiscard]] ProblemCard card() const override {
    return {.description = "swing-up of a pendulum with least torque",
            .time_unit = {"s", 1.0},
            .configuration_units = {"rad"},
            .control_units = {"N m"}};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"theta"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"tau"}; }

  /// L = T - V for a unit mass.
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const double l = parameter("length");
    return 0.5 * l * l * x.v[0] * x.v[0] + 9.81 * l * cos(x.q[0]);
  }
  /// The force on each coordinate.
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  /// The integrand of the cost.
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }

  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Constant(1, 0.0));
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Constant(1, std::numbers::pi));
  }
  [[nodiscard]] double horizon() const override { return 1.5; }
  // Also: bounds(), path_constraints(x), boundary_conditions(...), guess(t), final_cost(x), cost_scale().
};

}  // namespace dmocbench
)";

constexpr const char* build_file = R"(cmake_minimum_required(VERSION 3.25)
project(NAME LANGUAGES CXX)
find_package(dmocbench REQUIRED)
dmocbench_add_problems(NAME NAME.hpp)
)";

/// The text with every `word` replaced.
std::string with(std::string text, const std::string& word, const std::string& replacement) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + replacement.size()))
    text.replace(at, word.size(), replacement);
  return text;
}

/// PendulumSwingUp of pendulum_swing_up.
std::string in_camel_case(const std::string& name) {
  std::string result;
  bool begins_word = true;
  for (const char letter : name) {
    if (letter != '_')
      result += begins_word ? static_cast<char>(std::toupper(static_cast<unsigned char>(letter))) : letter;
    begins_word = letter == '_';
  }
  return result;
}

void require_name(const std::string& name) {
  const auto is_allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  const bool begins_with_letter = !name.empty() && name.front() >= 'a' && name.front() <= 'z';
  if (begins_with_letter && std::ranges::all_of(name, is_allowed)) return;
  throw Error(
      "the name of a problem consists of lower-case letters, digits and underscores, such as pendulum_swing_up, not {}",
      name);
}

int write_problem(CommandLine& line) {
  std::string name;
  line.option("NAME", name, "name of the problem, of its header and of its library, such as pendulum_swing_up");
  line.example("pendulum_swing_up");
  line.exit_code_1("");
  line.parse();
  require_name(name);
  const std::array files{std::pair(name + ".hpp", with(header, "CLASS", in_camel_case(name))),
                         std::pair(std::string("CMakeLists.txt"), with(build_file, "NAME", name))};
  for (const auto& [file, text] : files) {
    std::error_code none;  // a failed lookup counts as missing
    if (std::filesystem::exists(file, none)) throw Error("{} already exists; move it away first", file);
  }
  for (const auto& [file, text] : files) write_file(file, text);
  fmt::print(
      "wrote {0}.hpp and CMakeLists.txt; next:\n"
      "  cmake -B build && cmake --build build\n"
      "  dmocbench solve --library build/lib{0}.so --problem {0} --method dmoc\n"
      "  dmocbench study --library build/lib{0}.so --problem {0}\n",
      name);
  return 0;
}

int run(int argc, char** argv) {
  return run_program("new",
                     "Writes two files to the current folder: NAME.hpp, the skeleton of a problem, and a "
                     "CMakeLists.txt that builds it as a library.",
                     argc, argv, write_problem);
}

}  // namespace dmocbench::new_program
