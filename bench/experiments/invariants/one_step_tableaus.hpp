#pragma once

#include <utility>
#include <vector>

#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

/// Every tableau, each family with each number of stages, except tableaus whose neighbouring intervals share controls:
/// on a single interval they are the same method as tableaus without shared controls.
[[nodiscard]] inline std::vector<Tableau> one_step_tableaus() {
  std::vector<Tableau> tableaus;
  for (const std::string& family : tableau_names()) {
    for (const int stages : tableau_stages(family)) {
      Tableau tableau = make_tableau(family, stages);
      if (!tableau.shares_controls) tableaus.push_back(std::move(tableau));
    }
  }
  return tableaus;
}

}  // namespace dmocbench
