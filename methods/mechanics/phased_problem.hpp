#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/links.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Phases that follow each other, each a problem of its own, as one problem.
///
/// The phases run side by side over one relative time: with the duration T_i of phase i and its share s_i = T_i / H of
/// the horizon H, the mean of the guessed durations,
///
///   L = Σ s_i L_i(q_i, q̇_i / s_i, s_i t),  f = (s_i f_i),  C = Σ s_i C_i,  ẏ = (s_i g_i),  Φ = Σ Φ_i,
///
/// and the conditions of switches are boundary conditions. The discrete equations equal the equations of a sequence of
/// grids with N intervals each. Free durations (`bounds().horizon` of a phase) are unknown parameters `duration_NAME`.
/// Coordinates, first-order states and controls are called NAME_of_phase, '_' and their names in the phase. Bounds on
/// ends, on states and on controls, path constraints, constraints g(q) = 0 and A(q) q̇ = 0, integrals, boundary
/// conditions and the guess of every phase hold as it states them, in its own velocities and its own time, which begins
/// at 0. The ends of a phase at a switch have to be free in its `bounds()` where the switch determines them.
///
/// Phases may have parameters; one that several of them have is the same one.
class PhasedProblem : public Problem {
 public:
  /// A part of the motion.
  struct Phase {
    std::string name;                        ///< begins the names of its columns
    std::shared_ptr<const Problem> problem;  ///< its statement; phases may share one
    /// The phase whose end is the other side of the switch into this one; by default the phase before. Two phases that
    /// follow the same one are branches.
    std::optional<std::size_t> follows = {};
  };

  /// Entries of a phase that follow each other in a vector of the whole.
  struct Slice {
    Eigen::Index first = 0;  ///< number of the first of them
    Eigen::Index size = 0;   ///< how many there are

    /// The number after the last one.
    [[nodiscard]] Eigen::Index end() const noexcept { return first + size; }
    /// These of a vector.
    template <class Vector>
    [[nodiscard]] auto of(const Vector& all) const {
      return all.segment(first, size);
    }
  };
  /// Where a phase stands in the vectors of the whole.
  struct Part {
    Slice q = {};                   ///< coordinates, and their velocities
    Slice u = {};                   ///< controls
    Slice y = {};                   ///< first-order states
    Slice path = {};                ///< path constraints of its own
    Slice bounded_velocities = {};  ///< path constraints that are its bounded velocities
    bool is_free = false;           ///< whether its duration is an unknown
  };

  /// `parameters`: further ones, such as impulses (`Parameter::is_unknown`) or a total time. Throws `Error` if there is
  /// no phase, two have one name, a duration has no positive lower bound, a phase follows none of those before it, or a
  /// parameter of one name has different values or ranges.
  explicit PhasedProblem(std::vector<Phase> phases, std::vector<Parameter> parameters = {});

  /// The conditions of switch i, into phase i + 1: entries that vanish, as many as the state after the switch has
  /// components that are not given, and one more per condition on the state before it (the guard) and per unknown that
  /// they determine. Default: q, v and y are continuous. `links.hpp` has further ones.
  [[nodiscard]] virtual ExpressionVector link(std::size_t i, const PhaseEnd& before, const PhaseEnd& after) const;
  /// Conditions that read several ends, entries that vanish: a periodic motion, a total time `last.back().t - 1.2`.
  /// Default: none.
  [[nodiscard]] virtual ExpressionVector conditions(const std::vector<PhaseEnd>& first,
                                                    const std::vector<PhaseEnd>& last) const;

  /// All phases in their order.
  [[nodiscard]] const std::vector<Phase>& phases() const noexcept { return phases_; }
  /// Where each phase stands.
  [[nodiscard]] const std::vector<Part>& parts() const noexcept { return parts_; }
  /// The coordinates of phase i whose velocities have a bound.
  [[nodiscard]] std::vector<Eigen::Index> bounded_velocities(std::size_t i) const {
    return phase_bounds(i).bounded_velocities();
  }
  /// Of the unknown T_i.
  [[nodiscard]] std::string name_of_duration(std::size_t i) const;
  /// The conditions of switch i at two states in the time and the velocities of their own phases.
  [[nodiscard]] ExpressionVector link_of(std::size_t i, const State& before, const State& after) const;
  /// T_i: an unknown, or a number.
  [[nodiscard]] Expression duration(std::size_t i) const;
  /// The time of the whole motion at which phase i begins.
  [[nodiscard]] Expression start_time(std::size_t i) const;
  /// The phase that ends where phase i > 0 begins.
  [[nodiscard]] std::size_t preceding(std::size_t i) const { return phases_[i].follows.value_or(i - 1); }

  [[nodiscard]] const PhasedProblem* phased() const final { return this; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override;
  [[nodiscard]] std::vector<std::string> configuration_names() const final;
  [[nodiscard]] std::vector<std::string> control_names() const final;
  [[nodiscard]] std::vector<std::string> first_order_names() const final;
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const final;
  [[nodiscard]] Expression lagrangian(const State& x) const final;
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const final;
  [[nodiscard]] Expression running_cost(const ControlledState& x) const final;
  [[nodiscard]] BoundaryState initial_state() const final { return ends(&Problem::initial_state); }
  [[nodiscard]] BoundaryState final_state() const final { return ends(&Problem::final_state); }
  /// H, the mean of the guessed durations.
  [[nodiscard]] double horizon() const final;
  [[nodiscard]] ProblemBounds bounds() const final;
  /// The phases' own, then the bounded velocities of phases with a free duration.
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const final;
  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const final;
  [[nodiscard]] ExpressionVector velocity_constraints(const ExpressionVector& q, const ExpressionVector& v) const final;
  [[nodiscard]] ExpressionVector integrands(const ControlledState& x) const final;
  [[nodiscard]] ExpressionVector boundary_conditions(const State& first, const State& last) const final;
  /// "the link from fall to rise, entry [0]": entry i of `boundary_conditions`.
  [[nodiscard]] std::string condition_in_words(std::size_t i) const;
  /// The sum of the phases' final costs.
  [[nodiscard]] Expression final_cost(const State& last) const final;
  /// Of the phases that have one; 0 in the others. None if no phase has one.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const final;
  [[nodiscard]] MotionPoint guess(double t) const override;

 private:
  struct NamedConditions {
    std::string name;
    ExpressionVector entries;
  };

  [[nodiscard]] std::vector<NamedConditions> named_conditions(const State& first, const State& last) const;
  [[nodiscard]] std::string name_of_link(std::size_t i) const;
  void add_phase(Phase phase);
  /// `call(phase i)`, whose parameters are this problem's.
  template <class Call>
  [[nodiscard]] auto in_phase(std::size_t i, const Call& call) const {
    const SharedParameters parameters(*this, *phases_[i].problem);
    return call(*phases_[i].problem);
  }
  /// `formula(i, phase i)` of all phases, one after the other.
  template <class Formula>
  [[nodiscard]] ExpressionVector of_all(const Formula& formula) const;
  /// "NAME_name" of the `names(phase)` of all phases.
  template <class Names>
  [[nodiscard]] std::vector<std::string> names_of(const Names& names) const;
  /// s_i.
  [[nodiscard]] Expression share(std::size_t i) const;
  /// s_i as guessed.
  [[nodiscard]] double guessed_share(std::size_t i) const;
  [[nodiscard]] State in_own_velocities(std::size_t i, const State& x) const;
  [[nodiscard]] ControlledState in_own_velocities(std::size_t i, const ControlledState& x) const;
  [[nodiscard]] BoundaryState ends(BoundaryState (Problem::*end)() const) const;
  [[nodiscard]] ProblemBounds phase_bounds(std::size_t i) const;
  /// Throws `Error` if the range of a free duration has changed with the parameters since the construction.
  void require_stated_range(std::size_t i, const HorizonBounds& now) const;
  void add_interior(ProblemBounds& all, std::size_t i, const InteriorBounds& at) const;
  /// Of a state with the phase's own time and velocities.
  [[nodiscard]] PhaseEnd end_of(std::size_t i, const State& own) const;
  /// The bounds of an end's velocities that are conditions, because an unknown duration divides these.
  [[nodiscard]] ExpressionVector end_velocities(std::size_t i, const State& own, bool is_last) const;
  /// `link`. Throws `Error` if its number of entries cannot be right.
  [[nodiscard]] ExpressionVector checked_link(std::size_t i, const PhaseEnd& before, const PhaseEnd& after) const;

  std::vector<Phase> phases_;
  std::vector<Part> parts_;
};

/// "t = 0.41" or "t = 0.41 to 0.5", in the unit of `ProblemCard::time_unit`; of a `PhasedProblem` the share of each
/// phase, "0.41 to 0.5 of each phase".
[[nodiscard]] std::string time_in_words(const Problem& problem, double from, std::optional<double> to = {});

}  // namespace dmocbench
