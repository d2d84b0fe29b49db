#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "methods/expression/tape.hpp"
#include "methods/expression/vectors.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// Formulas of a point (q, v, u, y, t) of the motion, evaluated on numbers, one point at a time.
class PointFunction {
 public:
  /// `formulas` is called once with the traced point and returns the outputs.
  PointFunction(Eigen::Index configuration_size, Eigen::Index control_size,
                const std::function<ExpressionVector(const ControlledState&)>& formulas,
                Eigen::Index first_order_size = 0);
  /// The same with the sizes of a problem, or of a traced one.
  template <class AnyProblem>
  PointFunction(const AnyProblem& problem, const std::function<ExpressionVector(const ControlledState&)>& formulas)
      : PointFunction(problem.configuration_size(), problem.control_size(), formulas, problem.first_order_size()) {}
  // The tape's inputs point into this object.
  PointFunction(const PointFunction&) = delete;
  PointFunction& operator=(const PointFunction&) = delete;
  ~PointFunction() = default;

  /// The outputs at a point; `result` has `output_count()` entries. An empty `u` means u = 0; `y` has an entry per
  /// first-order state.
  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& q, const Eigen::Ref<const Eigen::VectorXd>& v,
                const Eigen::Ref<const Eigen::VectorXd>& u, double t, Eigen::Ref<Eigen::VectorXd> result,
                const Eigen::Ref<const Eigen::VectorXd>& y = Eigen::VectorXd());

  /// The values at a point and a time, into output_count() entries of `result`.
  void evaluate(const MotionPoint& point, double t, const Eigen::Ref<Eigen::VectorXd>& result) {
    evaluate(point.q, point.v, point.u, t, result, point.y);
  }

  /// How many numbers it has at a point.
  [[nodiscard]] Eigen::Index output_count() const noexcept { return static_cast<Eigen::Index>(outputs_.size()); }

 private:
  Eigen::Index n_ = 0;
  Eigen::Index m_ = 0;
  Eigen::Index l_ = 0;
  Tape tape_;
  Tape::Workspace workspace_;
  Eigen::VectorXd point_;
  std::vector<Tape::Input> inputs_;
  std::vector<double*> outputs_;
};

}  // namespace dmocbench
