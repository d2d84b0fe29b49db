#include "methods/transcription/local_functions.hpp"

#include "methods/expression/derivatives.hpp"

namespace dmocbench {

namespace {

LocalVector nonzeros(const ExpressionVector& dense) {
  LocalVector vector;
  std::vector<Expression> entries;
  for (Eigen::Index i = 0; i < dense.size(); ++i) {
    if (dense[i].is_zero()) continue;
    entries.push_back(dense[i]);
    vector.places.push_back(static_cast<std::size_t>(i));
  }
  vector.schedule = Schedule(entries);
  return vector;
}

LocalMatrix nonzeros(const ExpressionMatrix& dense, bool lower_triangle) {
  LocalMatrix matrix;
  std::vector<Expression> entries;
  for (Eigen::Index i = 0; i < dense.rows(); ++i) {
    for (Eigen::Index j = 0; j < (lower_triangle ? i + 1 : dense.cols()); ++j) {
      if (dense(i, j).is_zero()) continue;
      entries.push_back(dense(i, j));
      matrix.rows.push_back(static_cast<std::size_t>(i));
      matrix.columns.push_back(static_cast<std::size_t>(j));
    }
  }
  matrix.schedule = Schedule(entries);
  return matrix;
}

}  // namespace

Expression local_lagrangian(const Expression& cost, const ExpressionVector& rows, const LocalInputs& inputs) {
  Expression lagrangian = Expression::input(inputs.objective_factor()) * cost;
  for (std::size_t r = 0; r < inputs.rows; ++r) {
    lagrangian += Expression::input(inputs.multiplier(r)) * rows[static_cast<Eigen::Index>(r)];
  }
  return lagrangian;
}

LocalFunctions differentiate(const Expression& cost, const ExpressionVector& rows, std::size_t unknowns) {
  LocalFunctions functions;
  functions.inputs = {.unknowns = unknowns, .rows = static_cast<std::size_t>(rows.size())};
  const ExpressionVector z = input_vector(0, static_cast<Eigen::Index>(unknowns));
  const Expression lagrangian = local_lagrangian(cost, rows, functions.inputs);
  functions.cost = Schedule(std::vector<Expression>{cost});
  functions.gradient = nonzeros(gradient(cost, z));
  functions.rows = nonzeros(rows);
  functions.jacobian = nonzeros(jacobian(rows, z), false);
  functions.lagrangian = Schedule(std::vector<Expression>{lagrangian});
  functions.hessian = nonzeros(hessian(lagrangian, z), true);
  return functions;
}

ExpressionVector stacked(const std::vector<ExpressionVector>& parts) {
  Eigen::Index size = 0;
  for (const ExpressionVector& part : parts) size += part.size();
  ExpressionVector all(size);
  Eigen::Index next = 0;
  for (const ExpressionVector& part : parts) {
    all.segment(next, part.size()) = part;
    next += part.size();
  }
  return all;
}

}  // namespace dmocbench
