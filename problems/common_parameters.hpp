#pragma once

#include <string>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The parameter `gravity`, g in m/s². `lower` is the smallest for which the problem makes sense.
[[nodiscard]] inline Parameter gravity_parameter(double lower, double value = 9.81) {
  constexpr double largest = 1e3;
  return {.name = "gravity",
          .value = value,
          .unit = "m/s^2",
          .meaning = "gravitational acceleration",
          .lower = lower,
          .upper = largest};
}

/// The parameter `horizon`, T in s; `of` says whose duration it is.
[[nodiscard]] inline Parameter horizon_parameter(double value, const std::string& of = "") {
  constexpr double shortest = 1e-3;
  constexpr double longest = 1e3;
  return {.name = "horizon",
          .value = value,
          .unit = "s",
          .meaning = of.empty() ? "duration T" : "duration T of the " + of,
          .lower = shortest,
          .upper = longest};
}

/// A parameter that is 0 or 1; `meaning` says what both stand for.
[[nodiscard]] inline Parameter switch_parameter(const std::string& name, bool on, const std::string& meaning) {
  return {name, on ? 1.0 : 0.0, "", meaning, 0.0, 1.0, true};
}

}  // namespace dmocbench
