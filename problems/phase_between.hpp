#pragma once

#include <utility>
#include <vector>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A phase of a motion whose ends are given or open.
class PhaseBetween : public Problem {
 public:
  /// An end of the phase.
  struct End {
    BoundaryState state;   ///< the guess where it is open
    bool is_open = false;  ///< to the conditions of a switch
  };

  [[nodiscard]] BoundaryState initial_state() const override { return first_.state; }
  [[nodiscard]] BoundaryState final_state() const override { return last_.state; }
  [[nodiscard]] double horizon() const override { return guessed_duration_; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    if (first_.is_open) bounds.first = open(first_.state);
    if (last_.is_open) bounds.last = open(last_.state);
    bounds.horizon = duration_;
    return bounds;
  }

 protected:
  /// A duration between bounds, and its guess.
  PhaseBetween(End first, End last, HorizonBounds duration, double guessed_duration,
               std::vector<Parameter> parameters = {})
      : Problem(std::move(parameters)),
        first_(std::move(first)),
        last_(std::move(last)),
        duration_(duration),
        guessed_duration_(guessed_duration) {}

 private:
  static EndBounds open(const BoundaryState& state) {
    return {Bounds::none(state.q.size()), Bounds::none(state.v.size()), Bounds::none(state.y.size())};
  }

  End first_;
  End last_;
  HorizonBounds duration_;
  double guessed_duration_;
};

}  // namespace dmocbench
