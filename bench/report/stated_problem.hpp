#pragma once

#include <string>
#include <vector>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A formula of a problem and the name under which it is stated, as MathML: "L", or "f" with the name of a coordinate.
struct StatedFormula {
  std::string name;
  Expression value;
  std::string relation;  ///< the condition on the value, as MathML: "≥ 0"; may be empty
};

/// A problem's formulas as it states them, traced, with the parameters that may vary as letters and not as numbers.
struct StatedProblem {
  /// Letters for the parameters that the formulas read.
  struct Letter {
    std::string mathml;
    const Parameter* parameter = nullptr;  ///< of the problem
  };
  std::vector<Letter> letters;
  /// Names of the inputs of `along`, as MathML: the letters, q, q̇, u and t.
  std::vector<std::string> inputs;
  /// C, L, the components of f, of the constraints g and of the velocity constraints a, then of h.
  std::vector<StatedFormula> along;
  /// Names of the inputs of `at_ends`: the letters, q(0), q̇(0), q(T), q̇(T) and T.
  std::vector<std::string> end_inputs;
  bool has_final_cost = false;
  /// Φ, where there is one, then the components of r.
  std::vector<StatedFormula> at_ends;
  /// A letter that does not name any input, for parts that formulas share.
  std::string free_letter;
};

/// Traces the formulas of a problem, which has to outlive the result. Throws `Error` as `TracedProblem`.
[[nodiscard]] StatedProblem stated(const Problem& problem);

}  // namespace dmocbench
