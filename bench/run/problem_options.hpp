#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/run/command_line.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The options --problem, --set and --library of an experiment that takes problems by their names.
struct ProblemOptions {
  std::vector<std::string> problems = {};   ///< names; "all" for every one
  std::vector<std::string> settings = {};   ///< "parameter=value"
  std::vector<std::string> libraries = {};  ///< paths

  /// Registers the options; what they hold is the default.
  void add_to(CommandLine& line);
  /// The problems, after the command line was read: loads the libraries first. Throws `Error` as `selected_problems`
  /// and `load_problem_libraries`.
  [[nodiscard]] std::vector<std::shared_ptr<const Problem>> selected() const;
};

}  // namespace dmocbench
