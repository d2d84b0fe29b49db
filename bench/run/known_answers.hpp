#pragma once

#include <map>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "bench/run/solve_case.hpp"

namespace dmocbench {

/// The answers of one program that solves from many starts end at, each judged once.
///
/// Solves that end at one optimum differ by what their tolerance allows. An answer is rounded, every unknown and every
/// multiplier to a hundred-thousandth of the largest of its kind along the horizon, and Newton steps lead from there to
/// the optimum, which is the one that is judged. So what is told of an answer depends on the answer alone, not on those
/// that came before it. An answer from which no such steps lead back, to within what `settled` allows, is judged by
/// itself.
class KnownAnswers {
 public:
  /// The optimum of this solved case, judged; null where it has to be judged by itself. All cases must be those of one
  /// problem, program and tolerance.
  [[nodiscard]] std::shared_ptr<JudgedAnswer> find(const SolvedCase& solved);

  /// How many different ones there were.
  [[nodiscard]] std::size_t size() const noexcept { return answers_.size(); }

 private:
  std::map<std::vector<double>, std::shared_ptr<JudgedAnswer>> answers_;  // by the rounded one
};

}  // namespace dmocbench
