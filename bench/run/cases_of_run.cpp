#include "bench/run/cases_of_run.hpp"

#include "bench/run/case_list.hpp"

namespace dmocbench {

std::vector<Case> cases_of(const Experiment& experiment) {
  const ExperimentOptions& options = experiment.card().options;
  std::vector<Case> cases;
  for (const std::vector<Case>& curve : curves_of(expand_cases(options))) {
    const std::vector<Case> variants = experiment.variants(curve);
    cases.insert(cases.end(), variants.begin(), variants.end());
  }
  return with_tolerances(cases, chosen_tolerances(options));
}

Columns<SolvedCase> columns_of(const Experiment& experiment) {
  Columns<SolvedCase> columns = core_columns() + experiment.columns();
  return experiment.card().takes_turns ? columns + columns_of_rounds() : columns;
}

}  // namespace dmocbench
