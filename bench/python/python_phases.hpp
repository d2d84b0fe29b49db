#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "bench/python/python_object.hpp"
#include "methods/mechanics/phased_problem.hpp"

namespace dmocbench::python {

/// A problem of phases whose switches and conditions are implemented by an object of the Python class
/// `dmocbench.Phases`.
class PythonPhases final : public PhasedProblem {
 public:
  /// Of an object; as `PythonObject`.
  explicit PythonPhases(const pybind11::object& original);

  /// True if the object is one of `dmocbench.Phases`.
  [[nodiscard]] static bool is_one(const pybind11::object& original);

  [[nodiscard]] std::string name() const override { return python_.name(); }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return python_.copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override;
  [[nodiscard]] double cost_scale() const override;
  [[nodiscard]] ExpressionVector link(std::size_t i, const PhaseEnd& before, const PhaseEnd& after) const override;
  [[nodiscard]] ExpressionVector conditions(const std::vector<PhaseEnd>& first,
                                            const std::vector<PhaseEnd>& last) const override;

 private:
  /// With the names of the phase's coordinates.
  [[nodiscard]] pybind11::object point(std::size_t phase, const PhaseEnd& end) const;

  PythonObject python_;
};

}  // namespace dmocbench::python
