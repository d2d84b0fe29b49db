#include "bench/summary/column_meanings.hpp"

#include <set>

namespace dmocbench {

const ColumnMeanings& meanings_in_orders() {
  static const ColumnMeanings meanings{
      {"quantity", "the error whose order is fitted: the column of that name with _error behind it"},
      {"slope", "fitted order; empty where the verdict is not \"slope\""},
      {"standard_error", "of the order; empty with two points"},
      {"finest", "largest number of intervals used"},
      {"coarsest", "smallest number of intervals used"},
      {"points", "number of grids used"},
      {"floor", "error at which rounding begins; empty where none was measured"},
      {"verdict", "slope, floor (rounding leaves too few grids) or few grids"},
      {"jump_slope", "fitted order of the largest jump of an interval that is replayed alone"},
      {"jump_standard_error", "of that order"},
      {"error_slope", "fitted order of the state error on the same grids"},
      {"error_standard_error", "of that order"},
      {"orders_apart", "jump_slope minus error_slope"},
      {"error_of_jumps_coarsest", "state error by N times the jump on the coarsest grid"},
      {"error_of_jumps_finest", "the same on the finest grid"},
  };
  return meanings;
}

const ColumnMeanings& meanings_in_ratios() {
  static const ColumnMeanings meanings{
      {"quantity", "what is compared"},
      {"error", "that all methods of a problem and tableau reach"},
      {"intervals", "number of intervals N, not always whole where it is read off a curve"},
      {"variables", "number of free variables"},
      {"seconds", "[s] time of a solve"},
      {"variables_ratio", "variables by those of dmoc at this error"},
      {"seconds_ratio", "seconds by those of dmoc at this error"},
      {"currency", "what a solve is paid in"},
      {"ratio_at_equal_intervals", "of the method to dmoc on the same number of intervals"},
      {"ratio_at_equal_accuracy", "of the method to dmoc where their errors are the same"},
      {"ratio_lower", "of the interval of 95 % of ratio_at_equal_intervals, where rounds were timed"},
      {"ratio_upper", "of the same interval"},
      {"round_ratios", "the ratio in each round, with spaces between them"},
  };
  return meanings;
}

const ColumnMeanings& meanings_in_cold_starts() {
  static const ColumnMeanings meanings{
      {"start_kind", "what solves start from"},
      {"starts", "number of starts"},
      {"solved", "how many ended at a confirmed optimum of the discrete program"},
      {"solved_share", "of all starts"},
      {"solved_lower", "Wilson's interval of 95 % of the share"},
      {"solved_upper", "of the same interval"},
      {"confirmed", "how many were solved and whose intervals, replayed alone, join"},
      {"confirmed_share", "of all starts"},
      {"confirmed_lower", "Wilson's interval of 95 % of the share"},
      {"confirmed_upper", "of the same interval"},
      {"best", "how many were confirmed and cost no more than the reference, to the tolerance"},
      {"best_share", "of all starts"},
      {"best_lower", "Wilson's interval of 95 % of the share"},
      {"best_upper", "of the same interval"},
      {"elsewhere", "how many were confirmed and cost more than the reference"},
      {"too_coarse", "how many were solved, but are no motions on this grid"},
      {"lost", "how many were not solved"},
      {"failures", "the statuses of those that were not solved, each with its number"},
      {"below_reference", "how many of the best cost less than the reference"},
      {"certified_objective", "[cost] the certified optimum of the problem, where there is one"},
      {"reference_objective", "[cost] that answers are compared with"},
      {"reference_kind", "certified, or the lowest confirmed cost on the grid"},
      {"iterations_lower_quartile", "major iterations of the best answers"},
      {"iterations_median", "of the same"},
      {"iterations_upper_quartile", "of the same"},
      {"evaluations_lower_quartile", "evaluations of derivatives by the best answers"},
      {"evaluations_median", "of the same"},
      {"evaluations_upper_quartile", "of the same"},
      {"seconds_lower_quartile", "[s] time of the best answers"},
      {"seconds_median", "[s] of the same"},
      {"seconds_upper_quartile", "[s] of the same"},
      {"measure", "what the budget is counted in"},
      {"budget", "largest number of evaluations, or of seconds, that a solve may take"},
      {"share", "of all starts that are solved and confirmed within the budget"},
  };
  return meanings;
}

const ColumnMeanings& meanings_in_minima() {
  static const ColumnMeanings meanings{
      {"minimum", "number of the minimum, from the lowest cost upwards"},
      {"objective", "[cost] the lowest among the answers that are this minimum"},
      {"is_best", "yes for the lowest minimum that is a motion"},
      {"is_motion", "yes if the intervals of some answer, replayed one by one, join"},
      {"replay_confirmed", "yes if the replay of the whole horizon ends near the final state for some answer"},
      {"starts", "number of starts"},
      {"solved", "how many were solved"},
      {"unsolved", "how many were not solved"},
      {"unconfirmed", "how many ended in a minimum that is no motion"},
      {"best", "how many ended in the best minimum"},
      {"share", "best by starts"},
      {"share_lower", "Wilson's interval of 95 % of the share"},
      {"share_upper", "of the same interval"},
  };
  return meanings;
}

const ColumnMeanings& meanings_in_profiles() {
  static const ColumnMeanings meanings{
      {"measure", "what the profile is drawn of"},
      {"ratio", "what a competitor takes by what the best one takes on the same instance"},
      {"share", "of all instances on which the competitor stays within the ratio"},
      {"instances", "problems, each on every number of intervals"},
      {"successes", "instances that were solved to the reference"},
      {"common", "instances on which all competitors succeed"},
      {"seconds", "[s] shifted geometric mean over the common instances"},
      {"wins_seconds", "instances on which it is the fastest or as fast"},
      {"evaluations", "shifted geometric mean over the common instances"},
      {"wins_evaluations", "instances on which it takes the fewest or as few"},
      {"major_iterations", "shifted geometric mean over the common instances"},
      {"wins_major_iterations", "instances on which it takes the fewest or as few"},
      {"reference_digits", "certain digits of the reference"},
      {"relative_difference", "of the objective from the reference, with its sign"},
  };
  return meanings;
}

void explain(Table& table, const ColumnMeanings& meanings) {
  static const std::set<std::string> texts{"quantity",   "verdict",   "currency",        "round_ratios",
                                           "start_kind", "failures",  "measure",         "reference_kind",
                                           "is_best",    "is_motion", "replay_confirmed"};
  static const std::set<std::string> counts{"points",
                                            "starts",
                                            "solved",
                                            "confirmed",
                                            "best",
                                            "elsewhere",
                                            "too_coarse",
                                            "lost",
                                            "below_reference",
                                            "minimum",
                                            "unsolved",
                                            "unconfirmed",
                                            "instances",
                                            "successes",
                                            "common",
                                            "wins_seconds",
                                            "wins_evaluations",
                                            "wins_major_iterations"};
  table.explain(meanings);
  std::map<std::string, FieldType> types;
  for (const auto& [column, meaning] : meanings) {
    types[column].kind = texts.contains(column)    ? FieldKind::text
                         : counts.contains(column) ? FieldKind::integer
                                                   : FieldKind::number;
  }
  table.declare(types);
}

}  // namespace dmocbench
