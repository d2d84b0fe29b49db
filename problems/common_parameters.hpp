#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The parameter `gravity`, g in m/s². `lower` is the smallest for which the problem makes sense.
[[nodiscard]] inline Parameter gravity_parameter(double lower, double value = 9.81) {
  return {"gravity", value, "m/s^2", "gravitational acceleration", lower, 1e3};
}

/// The parameter `horizon`, T in s. `of` names the motion that takes this time, for its description: "swing".
[[nodiscard]] inline Parameter horizon_parameter(double value, const std::string& of = "") {
  return {"horizon", value, "s", of.empty() ? "duration T" : "duration T of the " + of, 1e-3, 1e3};
}

/// A parameter that is 0 or 1; `meaning` names both values.
[[nodiscard]] inline Parameter switch_parameter(const std::string& name, bool on, const std::string& meaning) {
  return {name, on ? 1.0 : 0.0, "", meaning, 0.0, 1.0, true};
}

/// `optimum` if every parameter of the problem, except the ones named in `except`, has its default value; otherwise
/// nothing, because a certified optimum holds only for the data with which it was computed.
[[nodiscard]] inline std::optional<ReferenceOptimum> with_default_parameters(
    const Problem& problem, ReferenceOptimum optimum, std::initializer_list<std::string_view> except = {}) {
  if (!problem.has_default_parameters(except)) return std::nullopt;
  return optimum;
}

/// The certificate of an optimum that the indirect method found.
[[nodiscard]] inline std::string by_indirect_method(int digits) {
  return "the indirect method with Gauss schemes of orders 16 and 20; the replay of its control has the same cost to " +
         std::to_string(digits) + " digits";
}

}  // namespace dmocbench
