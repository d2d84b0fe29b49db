#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/kkt/intervals/interval_entries.hpp"
#include "methods/kkt/intervals/pass_kernel.hpp"
#include "methods/kkt/intervals/segment_group.hpp"
#include "methods/kkt/kkt_system.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/runtime/instruction_set.hpp"

namespace dmocbench::kkt {

/// The elimination of a horizon in a single pass from the last interval to the first, for programs whose state is given
/// at both ends. ν, the multiplier of the state d at the end, is carried through the last intervals only. As soon as
/// they reach every state, which Γ shows, it is eliminated,
///
///   ν = Γ⁻¹ (ΦᵀX + γ - d),   P + ΦΓ⁻¹Φᵀ,   p + ΦΓ⁻¹(γ - d),
///
/// and what is eliminated so far has its true end: at a minimum all further pivots are positive.
class SinglePass {
 public:
  enum class Outcome : unsigned char {
    solved,
    wrong_inertia,  ///< certainly
    undecided,  ///< a pivot is near zero, or one of an interval that carries ν negative, or Γ is badly conditioned
  };

  /// True if the pass is faster than segments and joints for a program, and its ends are given.
  [[nodiscard]] static bool suits(const NonlinearProgram& program, const IntervalEntries& entries);

  explicit SinglePass(const IntervalEntries& entries) : entries_(entries) {}
  /// Takes an order of elimination, and the kernel of an instruction set. Returns false if intervals that are
  /// eliminated in this order do not fit.
  [[nodiscard]] bool use(const EliminationPlan& plan, InstructionSet set);
  /// The steps of intervals and nodes and their multipliers are written if the system is `solved`.
  [[nodiscard]] Outcome solve(const EliminationPlan& plan, const NewtonArrays& arrays, const KktStep& step);

 private:
  [[nodiscard]] int carry_end_multiplier(const EliminationPlan& plan, const NewtonArrays& arrays, int carried);
  [[nodiscard]] bool factorise_reachability();
  void eliminate_end_multiplier();
  void find_end_multiplier();
  void write_ends(const KktStep& step) const;

  const IntervalEntries& entries_;
  PassKernel kernel_{};
  Pass pass_;
  std::vector<Scatter> scatters_;
  std::vector<PassGather> gathers_;
  std::vector<int> units_;
  std::vector<int> places_of_rows_;
  NumberLines numbers_;  // the value and all records
  NumberLines workspace_;
  Eigen::VectorXd last_sums_;
  Eigen::MatrixXd factor_;  // of Γ
  Eigen::MatrixXd solved_;  // L⁻¹ (Φᵀ, γ - d)
  Eigen::VectorXd end_;     // ν
};

}  // namespace dmocbench::kkt
