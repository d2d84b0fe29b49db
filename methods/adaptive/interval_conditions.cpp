#include "methods/adaptive/interval_conditions.hpp"

#include <cstddef>
#include <vector>

namespace dmocbench {

namespace {

Eigen::MatrixXd gathered(const std::vector<SeriesPlace>& places, Eigen::Index intervals, const Eigen::VectorXd& from) {
  Eigen::MatrixXd table(intervals, static_cast<Eigen::Index>(places.size()));
  for (Eigen::Index j = 0; j < table.cols(); ++j) {
    for (Eigen::Index k = 0; k < intervals; ++k) table(k, j) = from[index_of(places, j, k)];
  }
  return table;
}

void scatter(const std::vector<SeriesPlace>& places, const Eigen::MatrixXd& table, Eigen::VectorXd& to) {
  for (Eigen::Index j = 0; j < table.cols(); ++j) {
    for (Eigen::Index k = 0; k < table.rows(); ++k) to[index_of(places, j, k)] += table(k, j);
  }
}

}  // namespace

IntervalConditions::IntervalConditions(Transcription& program, const Eigen::VectorXd& primal,
                                       const Eigen::VectorXd& multipliers)
    : program_(program),
      hessians_(program.tabulate(program.functions().hessian.schedule, primal, multipliers)),
      jacobians_(program.tabulate(program.functions().jacobian.schedule, primal)) {}

LocalValues IntervalConditions::zero() const {
  const LocalInputs& inputs = program_.functions().inputs;
  return {Eigen::MatrixXd::Zero(hessians_.rows(), static_cast<Eigen::Index>(inputs.unknowns)),
          Eigen::MatrixXd::Zero(hessians_.rows(), static_cast<Eigen::Index>(inputs.rows))};
}

LocalValues IntervalConditions::times(const LocalValues& direction) const {
  LocalValues result = zero();
  program_.functions().hessian.for_each([&](Eigen::Index e, Eigen::Index i, Eigen::Index j) {
    result.unknowns.col(i).array() += hessians_.col(e).array() * direction.unknowns.col(j).array();
    if (i != j) result.unknowns.col(j).array() += hessians_.col(e).array() * direction.unknowns.col(i).array();
  });
  program_.functions().jacobian.for_each([&](Eigen::Index e, Eigen::Index i, Eigen::Index j) {
    result.rows.col(i).array() += jacobians_.col(e).array() * direction.unknowns.col(j).array();
    result.unknowns.col(j).array() += jacobians_.col(e).array() * direction.rows.col(i).array();
  });
  return result;
}

LocalValues IntervalConditions::picked(const Eigen::VectorXd& unknowns, const Eigen::VectorXd& rows) const {
  const ProgramBlocks& blocks = program_.blocks();
  return {gathered(blocks.unknown_places(), hessians_.rows(), unknowns),
          gathered(blocks.row_places(), hessians_.rows(), rows)};
}

void IntervalConditions::add(const LocalValues& values, Eigen::VectorXd& unknowns, Eigen::VectorXd& rows) const {
  const ProgramBlocks& blocks = program_.blocks();
  scatter(blocks.unknown_places(), values.unknowns, unknowns);
  scatter(blocks.row_places(), values.rows, rows);
}

}  // namespace dmocbench
