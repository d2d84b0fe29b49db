#pragma once

#include <cstddef>
#include <vector>

#include "bench/speed/subject.hpp"
#include "methods/expression/schedule.hpp"
#include "methods/transcription/interval_functions.hpp"

namespace dmocbench::speed {

/// The Hessian of the Lagrangian of one or more intervals by ADOL-C's driver hess_mat.
///
/// ADOL-C is handed the formula of ℓ and differentiates it itself, once recorded: multipliers, factor and step are
/// further independent variables, in whose directions nothing is differentiated. (To change them with set_param_vec is
/// no faster, and to record anew for every interval is slower.) The second derivatives are those in the directions of
/// the n local unknowns, all n in one pass; the drivers hessian and hessian2 are slower or the same. With several
/// intervals on one tape the n directions serve all of them at once, since no interval's ℓ depends on another's inputs
/// here: the compression that a graph colouring would find.
class AdolcHessian {
 public:
  /// `tag` is ADOL-C's number of the tape. Record small tapes before large ones: a small one recorded after
  /// a tape of 1024 intervals was measured to run some fifteen times slower, as if it carried the large one's
  /// variables.
  AdolcHessian(short tag, const Schedule& lagrangian, const LocalInputs& inputs, std::size_t intervals);

  [[nodiscard]] std::size_t intervals() const noexcept { return intervals_; }
  /// Intervals `first` .. `first` + intervals() - 1.
  void evaluate(const Subject& subject, std::size_t first);
  /// ∂²ℓ/∂z_i∂z_j of interval `first` + `offset` of the last evaluation.
  [[nodiscard]] double entry(std::size_t offset, std::size_t i, std::size_t j) const {
    return result_rows_[offset * input_count_ + i][j];
  }

 private:
  short tag_;
  std::size_t intervals_;
  std::size_t input_count_;  // of one interval
  std::size_t directions_;
  std::vector<double> seed_;
  std::vector<double> result_;
  std::vector<double*> seed_rows_;
  std::vector<double*> result_rows_;
};

}  // namespace dmocbench::speed
