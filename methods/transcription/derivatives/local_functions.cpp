#include "methods/transcription/derivatives/local_functions.hpp"

#include <span>

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

LocalMatrix nonzeros(const ExpressionMatrix& dense, bool lower_triangle, const Definitions& definitions = {}) {
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
  matrix.schedule = Schedule(entries, definitions);
  return matrix;
}

}  // namespace

LocalFunctions differentiate(const Expression& cost, const ExpressionVector& rows, std::size_t unknowns,
                             std::size_t parameters, Eigen::Index adjoint_size) {
  LocalFunctions functions;
  functions.inputs = {.unknowns = unknowns, .rows = static_cast<std::size_t>(rows.size()), .parameters = parameters};
  const ExpressionVector z = input_vector(functions.inputs.unknown(0), static_cast<Eigen::Index>(unknowns));
  Expression lagrangian = Expression::input(functions.inputs.objective_factor()) * cost;
  for (Eigen::Index r = 0; r < rows.size(); ++r) {
    lagrangian += Expression::input(functions.inputs.multiplier(static_cast<std::size_t>(r))) * rows[r];
  }
  functions.cost = Schedule(std::span(&cost, 1));
  functions.gradient = nonzeros(gradient(cost, z));
  functions.rows = nonzeros(rows);
  functions.jacobian = nonzeros(jacobian(rows, z), false);
  functions.lagrangian = Schedule(std::span(&lagrangian, 1));
  const DefinedDerivatives of_lagrangian = gradient_and_hessian(lagrangian, z);
  functions.hessian = nonzeros(of_lagrangian.hessian, true, of_lagrangian.definitions);
  functions.adjoint = Schedule(entries_of(of_lagrangian.gradient).first(static_cast<std::size_t>(adjoint_size)),
                               of_lagrangian.definitions);
  return functions;
}

}  // namespace dmocbench
