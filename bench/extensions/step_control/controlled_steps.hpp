#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "bench/experiments/invariants/long_time_energy.hpp"
#include "methods/extensions/step_control/step_control_map.hpp"

namespace dmocbench {

/// The choice of steps: all equal, or by a `StepRule`.
enum class StepPolicy : std::uint8_t { uniform, variational, imposed, from_left };
/// The quantity that σ reads.
enum class SigmaReads : std::uint8_t { nothing, distance, acceleration, thrust };

/// "uniform", "variational", "imposed" or "from_left".
[[nodiscard]] std::string_view name_of(StepPolicy policy);
/// "nothing", "distance", "acceleration" or "thrust".
[[nodiscard]] std::string_view name_of(SigmaReads sigma);

/// The choice of DMOC's steps along a Kepler ellipse.
struct StepChoice {
  StepPolicy rule = StepPolicy::uniform;
  SigmaReads sigma = SigmaReads::nothing;
  int stages = 1;  ///< of the Gauss tableau

  [[nodiscard]] std::string_view rule_name() const { return name_of(rule); }
  [[nodiscard]] std::string_view sigma_name() const { return name_of(sigma); }
};

/// σ: 1, |q|^exponent, |q̈|^(-1/2) of the unforced motion, (1 + (u/0.05)²)^(-1/2). All of them are
/// invariant under rotations.
[[nodiscard]] StepFunction step_function(SigmaReads sigma, double exponent);

/// DMOC from the pericentre of an ellipse by a choice of steps, with their number per period of the unforced motion.
class ControlledSteps {
 public:
  /// Throws `Error` if σ is not positive along the ellipse.
  ControlledSteps(double eccentricity, const StepChoice& choice, int steps_per_period, double exponent);

  /// The defect of symplecticity of the extended map (q, t, p, -E) ↦ (q, t, p, -E), largest over the steps of a period,
  /// and ε times the largest square of an entry of its Jacobian.
  struct Symplecticity {
    double defect = 0.0;
    double rounding = 0.0;
  };
  [[nodiscard]] Symplecticity symplecticity() const;

  /// Angular momentum under an arbitrary thrust of amplitude 0.1.
  struct Momentum {
    double change = 0.0;
    double work = 0.0;    ///< Σ h b_i f·ξ(Q_i)
    double defect = 0.0;  ///< largest |change - work| over the steps
  };
  [[nodiscard]] Momentum momentum(int steps) const;

  /// Energy minus initial energy, period by period.
  [[nodiscard]] std::vector<PeriodEnergy> energy(long long periods) const;

  /// The largest error of (q, v) over the nodes of one period, each at its own time, and the largest error of the
  /// energy.
  struct PeriodError {
    double state = 0.0;
    double energy = 0.0;
    double largest_step = 0.0;
    double smallest_step = 0.0;
  };
  [[nodiscard]] PeriodError error_of_a_period() const;

  /// Multiplications, additions, ... of one Newton pass over a step.
  [[nodiscard]] std::size_t operations() const { return map_.operations(); }

 private:
  [[nodiscard]] StepControlMap::From pericentre() const;
  [[nodiscard]] Eigen::MatrixXd no_thrust() const { return Eigen::MatrixXd::Zero(stages_, 1); }

  double eccentricity_;
  int stages_;
  int steps_per_period_;
  StepControlMap map_;
  double pace_;
};

}  // namespace dmocbench
