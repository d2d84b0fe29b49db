#include "methods/solvers/sqp/quadratic/basis.hpp"

#include <algorithm>
#include <ranges>
#include <utility>

namespace dmocbench::sqp {

bool BasisFactorisation::factorise(const QuadraticProgram& program, const std::vector<Eigen::Index>& basics) {
  replacements_.clear();
  if (basics.empty()) return true;  // SparseLU divides by the size
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t position = 0; position < basics.size(); ++position) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(program.columns, basics[position]); entry; ++entry) {
      entries.emplace_back(static_cast<int>(entry.row()), static_cast<int>(position), entry.value());
    }
  }
  Eigen::SparseMatrix<double> basis(program.row_count(), program.row_count());
  basis.setFromTriplets(entries.begin(), entries.end());
  factors_.compute(basis);
  if (factors_.info() != Eigen::Success) return false;
  // A basis that is singular up to rounding may still have factors; they do not give back a solution.
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(program.row_count());
  const Eigen::VectorXd product = basis * ones;
  constexpr double backward = 1e-3;
  return (factors_.solve(product) - ones).lpNorm<Eigen::Infinity>() < backward;
}

void BasisFactorisation::replace(Eigen::Index position, const Eigen::VectorXd& solved) {
  Replacement replacement{.position = position, .pivot = solved[position]};
  for (Eigen::Index i = 0; i < solved.size(); ++i) {
    if (i == position || solved[i] == 0.0) continue;
    replacement.rows.push_back(i);
    replacement.values.push_back(solved[i]);
  }
  replacements_.push_back(std::move(replacement));
}

Eigen::VectorXd BasisFactorisation::solve(const Eigen::VectorXd& y) const {
  if (y.size() == 0) return y;
  Eigen::VectorXd x = factors_.solve(y);
  for (const Replacement& replacement : replacements_) {
    const double value = x[replacement.position] / replacement.pivot;
    x[replacement.position] = value;
    for (std::size_t e = 0; e < replacement.rows.size(); ++e) x[replacement.rows[e]] -= replacement.values[e] * value;
  }
  return x;
}

Eigen::VectorXd BasisFactorisation::solve_transposed(const Eigen::VectorXd& y) const {
  if (y.size() == 0) return y;
  Eigen::VectorXd x = y;
  for (const Replacement& replacement : std::views::reverse(replacements_)) {
    double sum = x[replacement.position];
    for (std::size_t e = 0; e < replacement.rows.size(); ++e) sum -= replacement.values[e] * x[replacement.rows[e]];
    x[replacement.position] = sum / replacement.pivot;
  }
  return factors_.transpose().solve(x);
}

namespace {

/// Entries of the table may be this large: smaller bounds cost more exchanges and gain little.
constexpr double largest_entry = 4.0;
/// A smaller pivot means that the row depends on others.
constexpr double smallest_pivot = 1e-9;

bool is_slack(const QuadraticProgram& program, Eigen::Index j) { return j >= program.variable_count(); }

/// One Gauss-Jordan step: the basic column at `row` and the other column at `place` change their roles.
void exchange(BasisChoice& choice, Eigen::Index row, Eigen::Index place) {
  Eigen::MatrixXd& table = choice.table;
  const double pivot = table(row, place);
  const Eigen::VectorXd column = table.col(place);
  table.col(place).setZero();
  table(row, place) = 1.0;
  table.row(row) /= pivot;
  const Eigen::RowVectorXd pivot_row = table.row(row);
  for (Eigen::Index j = 0; j < table.cols(); ++j) {
    if (pivot_row[j] == 0.0) continue;
    const double kept = table(row, j);
    table.col(j) -= pivot_row[j] * column;
    table(row, j) = kept;
  }
  std::swap(choice.basics[static_cast<std::size_t>(row)], choice.others[static_cast<std::size_t>(place)]);
}

/// Exchanges while an entry is larger than the bound. Each exchange multiplies |det B| by that entry, so this ends.
void improve(BasisChoice& choice) {
  if (choice.table.size() == 0) return;
  while (true) {
    Eigen::Index row = 0;
    Eigen::Index place = 0;
    if (!(choice.table.cwiseAbs().maxCoeff(&row, &place) > largest_entry)) return;
    exchange(choice, row, place);
  }
}

/// Replaces the slacks in the basis, row by row, each by the variable with the largest pivot. A slack that has left
/// does not return.
void replace_slacks(const QuadraticProgram& program, BasisChoice& choice) {
  for (Eigen::Index row = 0; row < choice.table.rows(); ++row) {
    if (!is_slack(program, choice.basics[static_cast<std::size_t>(row)])) continue;
    Eigen::Index place = 0;
    if (!(choice.table.row(row).cwiseAbs().maxCoeff(&place) > smallest_pivot)) continue;
    exchange(choice, row, place);
    choice.table.col(place).setZero();
  }
}

/// Computes the table from factors of the basis, because rounding accumulates over many exchanges.
bool recompute(const QuadraticProgram& program, BasisChoice& choice) {
  BasisFactorisation factors;
  if (!factors.factorise(program, choice.basics)) return false;
  choice.table.resize(program.row_count(), static_cast<Eigen::Index>(choice.others.size()));
  for (std::size_t place = 0; place < choice.others.size(); ++place) {
    choice.table.col(static_cast<Eigen::Index>(place)) = factors.solve(program.column(choice.others[place]));
  }
  return choice.table.allFinite();
}

BasisChoice from_slacks(const QuadraticProgram& program, const std::vector<Eigen::Index>& candidates) {
  BasisChoice choice{.basics = program.slacks(), .others = candidates};
  std::erase_if(choice.others, [&](Eigen::Index j) { return is_slack(program, j); });
  static_cast<void>(recompute(program, choice));  // the slack basis is never singular
  if (choice.table.size() > 0) replace_slacks(program, choice);
  choice.others = candidates;
  std::erase_if(choice.others,
                [&](Eigen::Index j) { return std::ranges::find(choice.basics, j) != choice.basics.end(); });
  static_cast<void>(recompute(program, choice));
  improve(choice);
  static_cast<void>(recompute(program, choice));
  return choice;
}

}  // namespace

BasisChoice choose_basis(const QuadraticProgram& program, std::vector<Eigen::Index> basics,
                         std::vector<Eigen::Index> others) {
  BasisChoice choice{.basics = basics, .others = others};
  if (!recompute(program, choice)) {
    basics.insert(basics.end(), others.begin(), others.end());
    return from_slacks(program, basics);
  }
  const std::vector<Eigen::Index> before = choice.basics;
  improve(choice);
  if (choice.basics != before) static_cast<void>(recompute(program, choice));
  return choice;
}

BasisChoice crash_basis(const QuadraticProgram& program) {
  std::vector<Eigen::Index> movable;
  for (Eigen::Index j = 0; j < program.variable_count(); ++j) {
    if (program.lower[j] < program.upper[j]) movable.push_back(j);
  }
  return from_slacks(program, movable);
}

}  // namespace dmocbench::sqp
