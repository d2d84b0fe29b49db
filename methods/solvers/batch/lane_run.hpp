#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "methods/judgement/stop_rule.hpp"
#include "methods/kkt/intervals/lane_kkt.hpp"
#include "methods/program/solution.hpp"
#include "methods/program/status.hpp"
#include "methods/solvers/batch/batch_queue.hpp"
#include "methods/solvers/batch/lane_problem.hpp"
#include "methods/solvers/batch/lane_vector.hpp"
#include "methods/solvers/batch/phase_clock.hpp"
#include "methods/solvers/interior_point/constants.hpp"
#include "methods/solvers/interior_point/filter_line_search.hpp"
#include "methods/solvers/interior_point/newton_step.hpp"
#include "methods/solvers/interior_point/optimality_errors.hpp"

namespace dmocbench::batch {

/// The number of a lane as Eigen counts.
[[nodiscard]] constexpr Eigen::Index index_of(std::size_t lane) { return static_cast<Eigen::Index>(lane); }

namespace constants = interior_point::constants;

/// The interior-point method on eight instances side by side: the steps of `InteriorPointRun`
/// (interior_point_solver.cpp) for one, without second-order corrections, and with the first half of its restoration:
/// steps of least length to where the linearised constraints hold, until the filter accepts a point. Where there are
/// bounds, or these steps end, an instance is left to `interior_point`. Numbers in brackets are the equations, A-1 to
/// A-9 the steps, of Wächter and Biegler (2006).
///
/// All lanes go through the same round: system, line search, derivatives, judgement. Each has a phase, which defines
/// the meaning of a round for it; a lane whose inertia was wrong waits for the next round with a larger shift.
class LaneRun {
 public:
  /// The batch must outlive it.
  LaneRun(SharedBatch& batch, std::unique_ptr<LaneProgram> lanes, std::unique_ptr<kkt::LaneKkt> kkt);

  /// Runs until the generation has no more instances.
  void run();

 private:
  enum class LanePhase : std::uint8_t {
    idle,        ///< no instance
    fresh,       ///< its start has to be evaluated
    estimating,  ///< the next system gives the least-squares multipliers, (36)
    newton,      ///< the next system gives a Newton step, (13)
    restoring,   ///< the next system gives the shortest step to where the linearised constraints hold
  };
  struct Lane {
    LanePhase phase = LanePhase::idle;
    Assignment assignment;
    interior_point::FilterLineSearch line_search;
    interior_point::InertiaShift shift;
    double mu = 0.0;
    // State of the present step.
    bool is_searching = false;  ///< its length is not accepted yet
    bool moves = false;         ///< there is one
    bool waits = false;         ///< for another attempt at its system in the next round
    double derivative = 0.0;    ///< of φ along it
    double smallest_length = 0.0;
    double share_moved = 0.0;  ///< how far it went, as `NewtonCorrections` measures it
    bool is_newton = false;    ///< it was a full Newton step
    int iterations = 0;
    int systems = 0;
    EvaluationCounts evaluations;
  };

  void refill();
  void begin(std::size_t number);
  // The parts of a round.
  void solve_systems();
  void search_lines();
  void differentiate();
  void judge();

  [[nodiscard]] kkt::LaneKkt::Systems systems();
  void assemble_systems(const OfLanes& shift);
  void begin_search(std::size_t number);
  void search(const LaneMask& fresh);
  [[nodiscard]] bool try_step(std::size_t number);
  // Restoration of feasibility.
  [[nodiscard]] bool begin_restoration(std::size_t number);
  [[nodiscard]] bool try_feasibility_step(std::size_t number);
  [[nodiscard]] bool is_restored(std::size_t number);
  void evaluate_start(std::size_t number);
  void judge(std::size_t number);
  [[nodiscard]] const LaneVector& with_bounds() const;
  [[nodiscard]] bool is_solved(std::size_t number) const;
  void update_barrier_parameter(std::size_t number);
  void refuse(std::size_t number, const char* reason);
  void give_up(std::size_t number);
  [[nodiscard]] bool has_small_cost(std::size_t number) const;
  void finish(std::size_t number, Status status);
  [[nodiscard]] interior_point::PointValues values_in(std::size_t number, const LaneValues& values) const;
  [[nodiscard]] bool is_warm(std::size_t lane) const;
  /// The distance by which a start is pushed away from its bounds.
  [[nodiscard]] double push_of(std::size_t lane) const;
  [[nodiscard]] bool is_anyone(LanePhase phase) const;
  /// A number of every lane, `value(lane)`.
  template <class Value>
  [[nodiscard]] OfLanes of_lanes(const Value& value) const {
    OfLanes result;
    for (std::size_t lane = 0; lane < instance_lanes; ++lane) result[index_of(lane)] = value(lanes_[lane]);
    return result;
  }

  const BatchOptions& options_;
  BatchQueue queue_;
  PhaseClock clock_;
  LaneProblem problem_;
  std::unique_ptr<kkt::LaneKkt> kkt_;
  RoundingFloors floors_;  // of the program as the batch began
  StopRule stop_rule_;
  double rounding_of_theta_;
  std::array<Lane, instance_lanes> lanes_;

  // The iterates.
  LaneVector primal_;
  LaneVector multipliers_;  // λ
  LaneVector z_;
  LaneValues values_;
  LaneVector trial_;
  LaneValues trial_values_;
  // The steps.
  LaneVector step_;
  LaneVector multiplier_step_;
  LaneVector z_step_;
  OfLanes length_;         // α
  OfLanes share_of_step_;  // see share_moved
  // The systems.
  LaneVector sigma_;                                  // Σ; later with δ_w, the diagonal
  OfLanes shift_in_sigma_ = OfLanes::Constant(-1.0);  // of all its entries, where there are no bounds; else negative
  LaneVector gradient_;                               // of the right-hand side, with the barrier
  LaneVector compliance_;                             // (Σ_s + δ_w)⁻¹, one per constraint
  LaneVector residuals_;                              // of the right-hand side
  // Input of the judgement.
  std::array<interior_point::OptimalityErrors, instance_lanes> errors_;
  OfLanes size_of_gradient_;  // not finite where an entry is not
  OfLanes largest_multiplier_;
  LaneVector balanced_;  // the gradient of the Lagrangian with the multipliers of bounds
  Solution solution_;    // memory of the answer that is delivered
};

}  // namespace dmocbench::batch
