#include "methods/mechanics/formula_check.hpp"

#include <cmath>

#include <fmt/format.h>

#include "methods/expression/derivatives.hpp"

namespace dmocbench {

FormulaCheck::FormulaCheck(const Problem& problem, Derivatives up_to)
    : formulas_(
          problem.configuration_size(), problem.control_size(),
          [&](const ControlledState& x) { return trace(problem, x, up_to); }, problem.first_order_size()),
      values_(formulas_.output_count()) {}

ExpressionVector FormulaCheck::trace(const Problem& problem, const ControlledState& x, Derivatives up_to) {
  ExpressionVector inputs(x.q.size() + x.v.size() + x.u.size() + x.y.size());
  inputs << x.q, x.v, x.u, x.y;
  std::vector<Expression> outputs;
  const auto add = [&](const ExpressionVector& entries, const std::string& name) {
    append(outputs, entries);
    names_.resize(outputs.size(), name);
  };
  const auto add_formula = [&](const char* name, const ExpressionVector& formula) {
    for (Eigen::Index i = 0; i < formula.size(); ++i) {
      const std::string entry = formula.size() > 1 ? fmt::format("{}[{}]", name, i) : name;
      add(formula.segment(i, 1), entry);
      add(gradient(formula[i], inputs), "a derivative of " + entry);
    }
    if (up_to == Derivatives::first || formula.size() == 0) return;
    add(gradient(gradient(formula.sum(), inputs).sum(), inputs), std::string("a second derivative of ") + name);
  };
  add_formula("lagrangian", ExpressionVector::Constant(1, problem.lagrangian(x.state())));
  add_formula("force", problem.force(x));
  add_formula("running_cost", ExpressionVector::Constant(1, problem.running_cost(x)));
  add_formula("path_constraints", problem.path_constraints(x));
  add_formula("constraints", problem.constraints(x.q));
  add_formula("first_order_rates", problem.first_order_rates(x));
  add_formula("integrands", problem.integrands(x));
  return Eigen::Map<const ExpressionVector>(outputs.data(), static_cast<Eigen::Index>(outputs.size()));
}

std::string FormulaCheck::undefined_at(const MotionPoint& point, double t) {
  formulas_.evaluate(point, t, values_);
  if (values_.allFinite()) return "";
  Eigen::Index i = 0;
  while (std::isfinite(values_[i])) ++i;
  return names_[static_cast<std::size_t>(i)];
}

}  // namespace dmocbench
