#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiment/table.hpp"
#include "bench/speed/solve_name.hpp"

namespace dmocbench::speed {

/// What all repetitions of a solve tell.
struct Solves {
  std::vector<double> seconds;
  std::vector<double> setup_seconds;  ///< of making the program
  double iterations = 0.0;
  double objective = 0.0;
  double evaluation_share = 0.0;
  bool is_solved = false;
  std::optional<double> linear_systems;      ///< none if the solver does not tell
  std::optional<double> bytes_per_interval;  ///< none where the system does not tell

  // 0 without repetitions.
  [[nodiscard]] double median() const;
  [[nodiscard]] double smallest() const;
  [[nodiscard]] double setup() const;  ///< median
};

using SolvesByName = std::map<SolveName, Solves>;

/// problem,method,intervals,solver,threads,repetitions,seconds,smallest_seconds,iterations,linear_systems,solved,
/// objective,ns_per_interval_iteration,evaluation_share,bytes_per_interval,setup_seconds: a row per benchmark, medians.
[[nodiscard]] Table solve_rows(const SolvesByName& solves);

/// problem,method,intervals,quantity,ratio,ratio_of_smallest,verdict: a row per pair of benchmarks that differ in
/// `quantity`: "solver", Ipopt's seconds over those of `interior_point`, or "threads", those of one thread over those
/// of two. A ratio stands only where both solved the program, confirmed by our residual, with equal objectives to 1e-9
/// (the verdict is "same"): a pair on different branches says nothing.
[[nodiscard]] Table solve_ratios(const SolvesByName& solves);

/// problem,method,solver,threads,exponent,standard_error,grids,coarsest,finest: a row per curve of at least three grids
/// from N = 1024 on that were solved. Below that a solve's fixed costs bend the line.
[[nodiscard]] Table solve_exponents(const SolvesByName& solves);

/// The three as text, for people.
[[nodiscard]] std::string solve_summary(const SolvesByName& solves);

}  // namespace dmocbench::speed
