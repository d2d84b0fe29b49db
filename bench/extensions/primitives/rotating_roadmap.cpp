#include <cmath>
#include <utility>
#include <vector>

#include "bench/extensions/primitives/roadmap_systems.hpp"
#include "methods/error.hpp"
#include "methods/extensions/primitives/stored_roadmap.hpp"
#include "methods/extensions/primitives/symmetry_group.hpp"
#include "methods/extensions/primitives/trim.hpp"

namespace dmocbench {

namespace {

constexpr int steps_of_rotation = 16;  // of the horizon
constexpr int intervals_of_rotation = 4;
/// The number of equal parts from the first trim's rate to the last one's.
constexpr int parts_of_rates = 4;

/// Trims at the rates ω_k = ω_0 + kδ, ω_0 the rate of the problem's first state and ω_K, K = `parts_of_rates`, of its
/// last; k = -1 .. K + 1.
///
/// In a time step Δ trim k turns by ω_0 Δ + kδΔ: seen from a frame that turns at the rate ω_0, angles stay on a lattice
/// of the width δΔ. The lattice of trim K is shifted so that it holds the goal.
class TurningTrims {
 public:
  explicit TurningTrims(const Problem& problem)
      : group_(problem), solver_(problem, group_), step_(problem.horizon() / steps_of_rotation) {
    const Trim first = trim_at(problem, problem.initial_state());
    const Trim last = trim_at(problem, problem.final_state());
    first_rate_ = first.rates[0];
    rate_spacing_ = (last.rates[0] - first_rate_) / parts_of_rates;
    if (rate_spacing_ == 0.0) throw Error(problem.name() + " turns at the same rate at both ends; set another target");
    for (int k = least; k <= most; ++k) {
      const double share = static_cast<double>(k) / parts_of_rates;
      Trim guess{.q = first.q + share * (last.q - first.q),
                 .rates = Eigen::VectorXd::Constant(1, first_rate_ + k * rate_spacing_),
                 .u = first.u};
      guess.q[turning_] = first.q[turning_];
      trims_.push_back(k == 0 ? first : solver_.solve(guess, shape_));
    }
    goal_angle_ = last.q[turning_] - first.q[turning_];
    const double beyond = goal_angle_ - first_rate_ * problem.horizon();
    last_offset_ = beyond - std::round(beyond / width()) * width();
  }

  static constexpr int least = -1;
  static constexpr int most = parts_of_rates + 1;
  /// The number of trim k among the states of the library.
  [[nodiscard]] static std::size_t state(int k) { return static_cast<std::size_t>(k - least); }

  [[nodiscard]] const std::vector<Trim>& trims() const noexcept { return trims_; }
  [[nodiscard]] double step() const noexcept { return step_; }
  /// The displacement by the angle that lies `places` of the lattice beyond the turn of trim 0 in so many time steps,
  /// from the lattice of trim `from` to the lattice of trim `to`.
  [[nodiscard]] Displacement turn(int from, int to, int duration, int places) const {
    const double between = (to == parts_of_rates ? last_offset_ : 0.0) - (from == parts_of_rates ? last_offset_ : 0.0);
    return by_angle(first_rate_ * step_ * duration + places * width() + between);
  }
  [[nodiscard]] Displacement to_goal() const { return by_angle(goal_angle_); }

 private:
  [[nodiscard]] Displacement by_angle(double angle) const {
    return group_.flow(Eigen::VectorXd::Constant(1, angle), 1.0);
  }
  [[nodiscard]] double width() const { return rate_spacing_ * step_; }

  /// The relative equilibrium that a state is on, without controls. The generator moves one coordinate alone.
  [[nodiscard]] Trim trim_at(const Problem& problem, const BoundaryState& state) {
    const Eigen::VectorXd axis = group_.velocity(state.q, Eigen::VectorXd::Ones(1));
    axis.cwiseAbs().maxCoeff(&turning_);
    if (axis != Eigen::VectorXd::Unit(axis.size(), turning_)) {
      throw Error("turning trims need a coordinate that is the angle about the axis");
    }
    shape_.clear();
    for (Eigen::Index i = 0; i < axis.size(); ++i) {
      if (i != turning_) shape_.push_back(i);
    }
    const Eigen::VectorXd rate = state.v.segment(turning_, 1);
    return solver_.solve({.q = state.q, .rates = rate, .u = Eigen::VectorXd::Zero(problem.control_size())},
                         {axis.size()});
  }

  SymmetryGroup group_;
  TrimSolver solver_;
  double step_;
  Eigen::Index turning_ = 0;         // the coordinate that is the angle
  std::vector<Eigen::Index> shape_;  // the others
  double first_rate_ = 0.0;
  double rate_spacing_ = 0.0;
  double goal_angle_ = 0.0;
  double last_offset_ = 0.0;
  std::vector<Trim> trims_;
};

/// Every trim for a time step, and maneuvers between any two of them.
std::vector<PrimitiveRequest> turning_requests(const TurningTrims& trims) {
  std::vector<PrimitiveRequest> requests;
  const auto add = [&](int from, int to, int duration, int places) {
    requests.push_back({.first = TurningTrims::state(from),
                        .last = TurningTrims::state(to),
                        .displacement = trims.turn(from, to, duration, places),
                        .duration = duration});
  };
  for (int from = TurningTrims::least; from <= TurningTrims::most; ++from) {
    add(from, from, 1, from);
    for (int to = TurningTrims::least; to <= TurningTrims::most; ++to) {
      for (const int duration : {2, 4, 8}) {
        const int mean = duration * (from + to) / 2;
        const int width = duration / 2;
        for (int places = mean - 2 * width; places <= mean + 2 * width; places += width)
          add(from, to, duration, places);
      }
    }
  }
  return requests;
}

}  // namespace

StoredRoadmap rotating_roadmap(const Problem& problem, const PrimitiveOptions& options) {
  const TurningTrims trims(problem);
  PrimitiveLibrary library = library_of_trims(problem, trims.trims(), trims.step(), intervals_of_rotation);
  solve_primitives(problem, turning_requests(trims), library, options);
  const Eigen::Index n = problem.configuration_size();
  return grow_roadmap(std::move(library),
                      {.start = {.state = TurningTrims::state(0), .moved = Displacement::identity(n)},
                       .goal = {.state = TurningTrims::state(parts_of_rates), .moved = trims.to_goal()},
                       .duration = steps_of_rotation});
}

}  // namespace dmocbench
