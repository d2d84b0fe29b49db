#include "methods/solvers/interior_point/intervals/recombined_kkt.hpp"

#include <utility>

#include "methods/error.hpp"
#include "methods/solvers/interior_point/intervals/interval_entries.hpp"

namespace dmocbench::interior_point {

namespace {

Eigen::Index at(std::size_t number) { return static_cast<Eigen::Index>(number); }

/// Calls `use` with what column `entries` of a pair's rows is in a combination of both, one number per interval.
template <class Combination, class Use>
void with_combined(const Combination& combination, const Eigen::VectorXd& values,
                   const std::array<std::size_t, 2>& entries, const Use& use) {
  const auto part = [&](std::size_t row) {
    return combination[row] * values.segment(at(entries[row]), combination[row].size()).array();
  };
  if (entries[0] == MomentumPair::none) {
    use(part(1));
  } else if (entries[1] == MomentumPair::none) {
    use(part(0));
  } else {
    use(part(0) + part(1));
  }
}

}  // namespace

std::unique_ptr<RecombinedKkt> RecombinedKkt::make(const NonlinearProgram& program, std::string& why,
                                                   SegmentKernelChoice choose) {
  const auto entries = interval_entries(program, ProgramRuns(program), why);
  if (!entries) return nullptr;
  auto pairs = momentum_pairs(program, *entries, why);
  if (!pairs) {
    why = "it is not the midpoint rule on (q, p): " + why;
    return nullptr;
  }
  try {
    return std::make_unique<RecombinedKkt>(program, std::move(*pairs), choose);
  } catch (const Error& error) {
    why = error.what();
    return nullptr;
  }
}

RecombinedKkt::RecombinedKkt(const NonlinearProgram& program, std::vector<MomentumPair> pairs,
                             SegmentKernelChoice choose)
    : pairs_(std::move(pairs)),
      recombined_(program, pairs_),
      unknowns_(recombined_.unknowns()),
      kept_rows_(recombined_.kept_rows()),
      kept_entries_(recombined_.kept_entries()),
      intervals_(at(program.interval_structure()->intervals)),
      combinations_(pairs_.size()) {
  std::string why;
  system_ = IntervalKkt::make(recombined_, why, choose);
  if (!system_) throw Error(why);
  const auto unknowns = at(recombined_.variable_count());
  const auto rows = at(recombined_.constraint_count());
  jacobian_.setZero(at(recombined_.jacobian_structure().size()));
  for (const RecombinedProgram::Constant& constant : recombined_.constants()) {
    jacobian_[constant.entry] = constant.value;
  }
  compliance_.setZero(rows);
  rows_.setZero(rows);
  multiplier_step_.setZero(rows);
  primal_step_.setZero(unknowns);
  diagonal_.setZero(unknowns);
  slope_.setZero(unknowns);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    combinations_[i].left_columns.setZero(intervals_, at(pairs_[i].columns.size()));
  }
}

/// With ∂(row 1, row 2)/∂p_k = (α_1, α_2) and ∂/∂p_{k+1} = (β_1, β_2): (β_2, -β_1) has p_k alone, (-α_2, α_1) p_{k+1}
/// alone, each once divided by α_1 β_2 - α_2 β_1. The right one is taken with -p_{k+1}, as the row of its node has it.
bool RecombinedKkt::find_combinations(const Eigen::VectorXd& jacobian) {
  const auto derivative = [&](std::size_t first) { return jacobian.segment(at(first), intervals_).array(); };
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto alpha_1 = derivative(pairs_[i].at_left[0]);
    const auto alpha_2 = derivative(pairs_[i].at_left[1]);
    const auto beta_1 = derivative(pairs_[i].at_right[0]);
    const auto beta_2 = derivative(pairs_[i].at_right[1]);
    scratch_ = (alpha_1 * beta_2 - alpha_2 * beta_1).inverse();
    if (!((scratch_ * 0.0).sum() == 0.0)) return false;
    Combinations& to = combinations_[i];
    to.left[0] = scratch_ * beta_2;
    to.left[1] = -scratch_ * beta_1;
    to.right[0] = scratch_ * alpha_2;
    to.right[1] = -scratch_ * alpha_1;
  }
  return true;
}

void RecombinedKkt::combine_jacobian(const Eigen::VectorXd& jacobian) {
  for (const RecombinedTerm& term : recombined_.terms()) {
    Combinations& combinations = combinations_[term.pair];
    const auto& entries = pairs_[term.pair].columns[term.column].entries;
    auto target = jacobian_.segment(at(term.first), intervals_).array();
    // The entry of an end that the first term of a diagonal left out.
    if (term.adds) target[term.of_right_node ? intervals_ - 1 : 0] = 0.0;
    const auto put = [&](const auto& values) {
      if (term.adds) {
        target += values;
      } else {
        target = values;
      }
    };
    if (term.of_right_node) {
      with_combined(combinations.right, jacobian, entries, put);
    } else {
      auto left = combinations.left_columns.col(at(term.column));
      with_combined(combinations.left, jacobian, entries, [&](const auto& values) { left = values; });
      put(left);
    }
  }
  kept_entries_.take_from(jacobian, jacobian_.tail(kept_entries_.size()));
}

double RecombinedKkt::combination_operations() const {
  constexpr double of_coefficients = 7.0;  // per pair: two products, a division, four products
  double count = of_coefficients * static_cast<double>(pairs_.size());
  for (const RecombinedTerm& term : recombined_.terms()) {
    for (const std::size_t entry : pairs_[term.pair].columns[term.column].entries) {
      count += entry == MomentumPair::none ? 0.0 : 1.0;
    }
  }
  return count;
}

void RecombinedKkt::combine_rows(const Eigen::VectorXd& rows) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    auto of_nodes = rows_.segment(at(i) * (intervals_ + 1), intervals_ + 1).array();
    of_nodes[intervals_] = 0.0;
    with_combined(combinations_[i].left, rows, pairs_[i].rows,
                  [&](const auto& values) { of_nodes.head(intervals_) = values; });
    with_combined(combinations_[i].right, rows, pairs_[i].rows,
                  [&](const auto& values) { of_nodes.tail(intervals_) += values; });
  }
  kept_rows_.take_from(rows, rows_.tail(kept_rows_.size()));
}

/// The slope along a momentum p_k that drops out is balanced by a multiplier of the row with p_k alone, -slope, whose
/// own slope along the other unknowns is added to theirs.
void RecombinedKkt::move_slope(const Eigen::VectorXd& slope) {
  const Eigen::Index between = intervals_ - 1;
  all_slopes_ = slope;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto of_momenta = slope.segment(at(pairs_[i].momentum) + 1, between).array();
    for (std::size_t column = 0; column < pairs_[i].columns.size(); ++column) {
      all_slopes_.segment(at(pairs_[i].columns[column].unknown) + 1, between).array() -=
          combinations_[i].left_columns.col(at(column)).tail(between) * of_momenta;
    }
  }
  unknowns_.take_from(all_slopes_, slope_);
}

/// From the row with p_k alone, which the steps of all else leave with a residual.
void RecombinedKkt::read_momenta(const Eigen::VectorXd& rows, Eigen::VectorXd& primal_step) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const MomentumPair& pair = pairs_[i];
    with_combined(combinations_[i].left, rows, pair.rows, [&](const auto& values) { scratch_ = values; });
    for (std::size_t column = 0; column < pair.columns.size(); ++column) {
      scratch_ += combinations_[i].left_columns.col(at(column)) *
                  primal_step.segment(at(pair.columns[column].unknown), intervals_).array();
    }
    primal_step.segment(at(pair.momentum) + 1, intervals_ - 1) = -scratch_.tail(intervals_ - 1);
  }
}

void RecombinedKkt::read_multipliers(const Eigen::VectorXd& slope, Eigen::VectorXd& multiplier_step) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto of_nodes = multiplier_step_.segment(at(i) * (intervals_ + 1), intervals_ + 1).array();
    scratch_ = of_nodes.head(intervals_);
    scratch_.tail(intervals_ - 1) -= slope.segment(at(pairs_[i].momentum) + 1, intervals_ - 1).array();
    for (const std::size_t row : {std::size_t{0}, std::size_t{1}}) {
      multiplier_step.segment(at(pairs_[i].rows[row]), intervals_) =
          combinations_[i].left[row] * scratch_ + combinations_[i].right[row] * of_nodes.tail(intervals_);
    }
  }
  kept_rows_.put_into(multiplier_step, multiplier_step_.tail(kept_rows_.size()));
}

FactorisationStatus RecombinedKkt::solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                         const KktStep& step) {
  const auto& [slope, rows] = right_hand_side;
  const auto& [primal_step, multiplier_step] = step;
  if (!find_combinations(matrix.jacobian)) return FactorisationStatus::singular;
  combine_jacobian(matrix.jacobian);
  combine_rows(rows);
  move_slope(slope);
  unknowns_.take_from(matrix.diagonal, diagonal_);
  if (matrix.compliance.size() > 0) kept_rows_.take_from(matrix.compliance, compliance_.tail(kept_rows_.size()));
  const FactorisationStatus verdict = system_->solve({matrix.hessian, jacobian_, diagonal_, compliance_},
                                                     {slope_, rows_}, {primal_step_, multiplier_step_});
  if (verdict != FactorisationStatus::solved) return verdict;
  unknowns_.put_into(primal_step, primal_step_);
  read_momenta(rows, primal_step);
  read_multipliers(slope, multiplier_step);
  return FactorisationStatus::solved;
}

}  // namespace dmocbench::interior_point
