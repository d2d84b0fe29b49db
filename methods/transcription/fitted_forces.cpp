#include "methods/transcription/fitted_forces.hpp"

#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace dmocbench {

namespace {

/// Some of the unknowns of a program, numbered consecutively: the columns of the least-squares problem.
class Numbered {
 public:
  explicit Numbered(std::size_t unknowns) : numbers_(unknowns, -1) {}
  /// The next ones; those that neighbouring intervals share have a number already.
  void add(std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      if (numbers_[i] < 0) numbers_[i] = count_++;
    }
  }
  /// -1 of others.
  [[nodiscard]] Eigen::Index number(Eigen::Index unknown) const { return numbers_[static_cast<std::size_t>(unknown)]; }
  [[nodiscard]] Eigen::Index count() const { return count_; }
  /// Adds to each of them.
  void move(const Eigen::VectorXd& by, Eigen::VectorXd& x) const {
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      if (number(i) >= 0) x[i] += by[number(i)];
    }
  }

 private:
  std::vector<Eigen::Index> numbers_;
  Eigen::Index count_ = 0;
};

Numbered fitted_unknowns(const Transcription& program, FittedForces with) {
  Numbered unknowns(program.variable_count());
  const Quantity fitted = with == FittedForces::controls ? Quantity::control : Quantity::second_rate;
  const ProgramBlocks& blocks = program.blocks();
  for (const UnknownBlock& block : blocks.interval_unknowns()) {
    if (block.kind != fitted && block.kind != Quantity::multiplier) continue;
    for (Eigen::Index i = 0; i < block.width; ++i) unknowns.add(block.at(i), blocks.intervals());
  }
  const UnknownBlock& last = blocks.unknown_at(Quantity::multiplier, blocks.intervals());
  unknowns.add(last.head, static_cast<std::size_t>(last.width));
  return unknowns;
}

/// By how much rows leave their bounds.
Eigen::VectorXd defects(Transcription& program, const Eigen::VectorXd& x) {
  Eigen::VectorXd rows(static_cast<Eigen::Index>(program.constraint_count()));
  program.constraints(x, rows);
  return rows - rows.cwiseMax(program.constraint_lower()).cwiseMin(program.constraint_upper());
}

/// The derivatives of the rows by the numbered unknowns.
Eigen::SparseMatrix<double> columns_of(Transcription& program, const Eigen::VectorXd& x, const Numbered& unknowns) {
  const BlockPattern& pattern = program.jacobian_structure();
  Eigen::VectorXd values(static_cast<Eigen::Index>(pattern.size()));
  program.jacobian(x, values);
  std::vector<Eigen::Triplet<double>> entries;
  pattern.for_each([&](Eigen::Index entry, int row, int column) {
    const Eigen::Index number = unknowns.number(column);
    if (number >= 0) entries.emplace_back(row, static_cast<int>(number), values[entry]);
  });
  Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(program.constraint_count()), unknowns.count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

void fit_forces(Transcription& program, FittedForces with, Eigen::VectorXd& x) {
  constexpr double least_change = 1e-10;  // weight of the size of a change, where several forces move alike
  constexpr int most_steps = 4;           // the first is the fit; others refine it
  const Numbered unknowns = fitted_unknowns(program, with);
  const Eigen::SparseMatrix<double> matrix = columns_of(program, x, unknowns);
  Eigen::SparseMatrix<double> normal = matrix.transpose() * matrix;
  Eigen::SparseMatrix<double> identity(unknowns.count(), unknowns.count());
  identity.setIdentity();
  normal += least_change * normal.diagonal().maxCoeff() * identity;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(normal);
  if (factors.info() != Eigen::Success) return;
  Eigen::VectorXd defect = defects(program, x);
  for (int step = 0; step < most_steps; ++step) {
    Eigen::VectorXd fitted = x;
    unknowns.move(factors.solve(-(matrix.transpose() * defect)), fitted);
    fitted = fitted.cwiseMax(program.variable_lower()).cwiseMin(program.variable_upper());
    const Eigen::VectorXd left = defects(program, fitted);
    if (!(left.norm() < defect.norm())) return;
    x = fitted;
    defect = left;
  }
}

}  // namespace dmocbench
