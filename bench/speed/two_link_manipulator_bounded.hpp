#pragma once

#include <optional>
#include <string>

#include "problems/two_link_manipulator.hpp"

namespace dmocbench::speed {

/// The paper's two-link manipulator with both torques between -16 and 16 N m, which is enough for the swing-up but less
/// than it takes without bounds: the least cost rises from 80.38 to 80.65.
class TwoLinkManipulatorBounded final : public TwoLinkManipulator {
 public:
  static constexpr double largest_torque = 16.0;

  [[nodiscard]] std::string name() const override { return "two_link_manipulator_bounded"; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = TwoLinkManipulator::bounds();
    bounds.u = Bounds::all(2, -largest_torque, largest_torque);
    return bounds;
  }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = TwoLinkManipulator::card();
    card.reference.reset();
    return card;
  }
};

}  // namespace dmocbench::speed
