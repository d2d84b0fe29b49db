#include "methods/expression/jacobian_at.hpp"

#include <algorithm>
#include <vector>

#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"

namespace dmocbench {

ExpressionMatrix jacobian_at(const VectorFormula& f, const ExpressionVector& x) {
  // Inputs that neither x nor f reads stand for x.
  const std::size_t read = std::max(Schedule(x).input_count(), Schedule(f(x)).input_count());
  const ExpressionVector stand_in = input_vector(read, x.size());
  const ExpressionMatrix derivative = jacobian(f(stand_in), stand_in);
  const ExpressionVector inputs = stacked({input_vector(0, static_cast<Eigen::Index>(read)), x});
  const std::vector<Expression> entries =
      replay<Expression>(Schedule(ExpressionVector(derivative.reshaped())), entries_of(inputs));
  return Eigen::Map<const ExpressionMatrix>(entries.data(), derivative.rows(), derivative.cols());
}

}  // namespace dmocbench
