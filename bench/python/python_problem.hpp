#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "bench/python/python_object.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench::python {

/// A problem whose members are implemented by an object of the Python class `dmocbench.Problem`.
class PythonProblem final : public Problem {
 public:
  /// Of an object; as `PythonObject`.
  explicit PythonProblem(const pybind11::object& original);

  [[nodiscard]] std::string name() const override { return python_.name(); }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return python_.copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override;
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return configuration_names_; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return control_names_; }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return first_order_names_; }

  [[nodiscard]] Expression lagrangian(const State& x) const override;
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override;
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override;
  [[nodiscard]] BoundaryState initial_state() const override { return numbers()->first; }
  [[nodiscard]] BoundaryState final_state() const override { return numbers()->last; }
  [[nodiscard]] double horizon() const override { return numbers()->horizon; }

  // Each optional member of `Problem` is one function here and one member of the Python class.
  [[nodiscard]] ProblemBounds bounds() const override { return numbers()->bounds; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    return optional_formula("first_order_rates", x);
  }
  [[nodiscard]] ExpressionVector integrands(const ControlledState& x) const override {
    return optional_formula("integrands", x);
  }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return optional_formula("path_constraints", x);
  }
  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    return optional_formula("constraints", q);
  }
  [[nodiscard]] ExpressionVector velocity_constraints(const ExpressionVector& q,
                                                      const ExpressionVector& v) const override;
  [[nodiscard]] ExpressionVector boundary_conditions(const State& first, const State& last) const override {
    return optional_formula("boundary_conditions", first, last);
  }
  [[nodiscard]] Expression final_cost(const State& last) const override;
  [[nodiscard]] double cost_scale() const override;
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override;
  [[nodiscard]] MotionPoint guess(double t) const override;

 private:
  /// The numbers that a problem states, for values of its parameters.
  struct Numbers {
    Eigen::VectorXd parameters;
    BoundaryState first;
    BoundaryState last;
    double horizon = 0.0;
    ProblemBounds bounds;
  };

  /// A member at points of the motion, as many entries as it has.
  template <class... Points>
  [[nodiscard]] ExpressionVector formula(const char* member, const Points&... points) const {
    return python_.formula(member, [&] { return pybind11::make_tuple(point(points)...); });
  }
  template <class... Points>
  [[nodiscard]] ExpressionVector optional_formula(const char* member, const Points&... points) const {
    return python_.states(member) ? formula(member, points...) : ExpressionVector();
  }
  template <class Point>
  [[nodiscard]] Expression single_formula(const char* member, const Point& x) const;
  /// Names the entries of a point in texts of formulas.
  void name_entries(const State& x) const;
  [[nodiscard]] pybind11::object point(const ExpressionVector& q) const;
  [[nodiscard]] pybind11::object point(const State& x) const;
  [[nodiscard]] pybind11::object point(const ControlledState& x) const;
  [[nodiscard]] std::shared_ptr<const Numbers> numbers() const;
  [[nodiscard]] Numbers read_numbers() const;

  PythonObject python_;
  std::vector<std::string> configuration_names_;
  std::vector<std::string> control_names_;
  std::vector<std::string> first_order_names_;
  bool has_constant_numbers_ = false;  ///< no number depends on a parameter
  mutable std::mutex last_numbers_use_;
  mutable std::shared_ptr<const Numbers> last_numbers_;  ///< the last that were read
};

}  // namespace dmocbench::python
