#include "bench/experiment/case_list.hpp"

namespace dmocbench {

std::vector<std::vector<Case>> curves_of(std::span<const Case> cases) {
  std::vector<std::vector<Case>> curves;
  for (const Case& the_case : cases) {
    if (curves.empty() || !curves.back().front().same_curve(the_case)) curves.emplace_back();
    curves.back().push_back(the_case);
  }
  return curves;
}

std::vector<Case> with_tolerances(const std::vector<Case>& cases, const std::vector<double>& tolerances) {
  if (tolerances.empty()) return cases;
  std::vector<Case> result;
  for (const std::vector<Case>& curve : curves_of(cases)) {
    for (const double tolerance : tolerances) {
      for (const Case& of_curve : curve) result.emplace_back(of_curve).tolerance = tolerance;
    }
  }
  return result;
}

}  // namespace dmocbench
