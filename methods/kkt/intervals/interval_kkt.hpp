#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "methods/kkt/intervals/boundary_system.hpp"
#include "methods/kkt/intervals/elimination_plan.hpp"
#include "methods/kkt/intervals/interval_entries.hpp"
#include "methods/kkt/intervals/segment_chain.hpp"
#include "methods/kkt/intervals/segment_group.hpp"
#include "methods/kkt/intervals/single_pass.hpp"
#include "methods/kkt/intervals/terminal_weights.hpp"
#include "methods/kkt/kkt_system.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::kkt {

/// The KKT system of a program with an interval structure, eliminated interval by interval in time and memory that grow
/// linearly with their number; README.md explains how.
class IntervalKkt : public KktSystem {
 public:
  /// The reason in a sentence for a program whose structure does not allow it (interval_entries.hpp).
  using Made = tl::expected<std::unique_ptr<IntervalKkt>, std::string>;
  [[nodiscard]] static Made make(const NonlinearProgram& program, InstructionSet set = preferred_instruction_set());

  /// `entries` and `boundary` belong to the program; `set` is the instruction set of the kernels. `make` does all.
  IntervalKkt(IntervalEntries entries, BoundarySystem boundary, InstructionSet set);

  void begin_solve() override { weights_.forget(); }
  [[nodiscard]] FactorisationStatus solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                          const KktStep& step) override;
  [[nodiscard]] bool is_certain() const noexcept override {
    return found_.is_certain && entries_.held_unknowns.empty();  // a larger penalty may show a minimum
  }

  [[nodiscard]] const Shape& shape() const noexcept { return entries_.shape; }
  /// Backward sweeps so far, with those for other terminal weights and other orders of elimination.
  [[nodiscard]] int eliminations() const noexcept { return eliminations_; }

 private:
  struct Elimination {
    FactorisationStatus status = FactorisationStatus::untrusted;
    bool is_certain = false;  ///< other terminal weights would find the same inertia
  };

  [[nodiscard]] NewtonArrays arrays_of(const KktMatrix& matrix, const KktRightHandSide& right_hand_side);
  [[nodiscard]] bool choose_plan(const NewtonArrays& arrays, const std::vector<Eigen::Index>& intervals);
  [[nodiscard]] Elimination join(const NewtonArrays& arrays, const KktMatrix& matrix,
                                 const KktRightHandSide& right_hand_side);
  [[nodiscard]] bool join_segments();
  void hold(const KktMatrix& matrix, NewtonArrays& arrays);
  void find_last_carry(const NewtonArrays& arrays);
  void substitute(const NewtonArrays& arrays, const KktStep& step);

  IntervalEntries entries_;
  BoundarySystem boundary_;
  InstructionSet set_;
  SegmentKernel kernel_{};
  bool has_plan_ = false;
  bool has_pass_ = false;  // its order of elimination suits a single pass
  Elimination found_;      // by the last sweep
  int eliminations_ = 0;
  EliminationPlan plan_;
  std::optional<SinglePass> single_pass_;  // where it suits the program
  TerminalWeights weights_;
  Eigen::MatrixXd last_carry_;  // node_sums x node

  Eigen::VectorXd padded_;
  Eigen::VectorXd held_diagonal_;
  std::vector<GroupMemory> groups_;
  SegmentValue segment_value_;
  SegmentChain chain_;
  Eigen::Index negative_ = 0;         // eigenvalues of the eliminated blocks, beyond their number at a minimum
  bool is_minimum_in_parts_ = false;  // the pivots of every segment and every joint belong to a minimum
  Eigen::MatrixXd states_;            // at the first nodes of the segments, one column each
  Eigen::MatrixXd multipliers_;
};

}  // namespace dmocbench::kkt
