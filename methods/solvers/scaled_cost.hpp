#pragma once

#include "methods/program/forwarding_program.hpp"

namespace dmocbench {

/// A program with its cost times a factor; its multipliers are the original's times the factor.
class ScaledCost final : public ForwardingProgram {
 public:
  /// `program` must outlive it.
  ScaledCost(NonlinearProgram& program, double factor) : ForwardingProgram(program), factor_(factor) {}

  [[nodiscard]] double objective(const VectorIn& x) override { return factor_ * original().objective(x); }
  void gradient(const VectorIn& x, VectorOut result) override {
    original().gradient(x, result);
    result *= factor_;
  }
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override {
    original().hessian(x, factor_ * objective_factor, multipliers, values);
  }

 private:
  double factor_;
};

}  // namespace dmocbench
