#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bench/experiments/sweep/swept_values.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// How the problems of a sequence follow each other.
class Neighbours {
 public:
  virtual ~Neighbours() = default;
  Neighbours(const Neighbours&) = delete;
  Neighbours& operator=(const Neighbours&) = delete;

  /// "receding_horizon" or "homotopy".
  [[nodiscard]] virtual std::string name() const = 0;
  /// The problem of step 1, 2, ... that follows the one whose solution is `last`.
  [[nodiscard]] virtual std::shared_ptr<const Problem> next(int step, const Trajectory& last) = 0;
  /// Gives the values of the last `next` to a program of the first problem.
  virtual void give_values(Transcription& program) const = 0;
  /// The parameters that such a program has to keep open.
  [[nodiscard]] virtual std::vector<std::string> open_parameters() const { return {}; }
  /// Whether a step moves on by one interval of the grid, and the start with it.
  [[nodiscard]] virtual bool moves_on() const = 0;

 protected:
  Neighbours() = default;
};

/// A controller that solves again after every interval: the next problem starts where the last solution is after its
/// first interval, with a disturbance; its final state moves on with its own velocity, so that a circular orbit stays
/// one and rest stays rest. The horizon keeps its length. A disturbance is drawn evenly for every entry of q and v, at
/// most `share` of the range of that entry along the first motion; equal seeds give equal ones.
[[nodiscard]] std::unique_ptr<Neighbours> receding_horizon(std::shared_ptr<const Problem> base,
                                                           const Trajectory& first_motion, double share,
                                                           std::uint64_t seed);

/// One quantity of the problem goes from its lower to its upper value in `steps` equal steps.
[[nodiscard]] std::unique_ptr<Neighbours> homotopy(std::shared_ptr<const Problem> base,
                                                   std::vector<std::string> settings, const SweptQuantity& quantity,
                                                   int steps);

}  // namespace dmocbench
