#include "methods/solvers/interior_point/intervals/recombined_kkt.hpp"

#include <utility>

#include "methods/error.hpp"
#include "methods/solvers/interior_point/intervals/interval_entries.hpp"

namespace dmocbench::interior_point {

namespace {

Eigen::Index at(std::size_t number) { return static_cast<Eigen::Index>(number); }

/// Adds what column `entries` of a pair's rows is in the combination of both, one number per interval.
template <class Combination, class Target>
void add_combined(const Combination& combination, const Eigen::VectorXd& values,
                  const std::array<std::size_t, 2>& entries, Target&& target) {
  for (const std::size_t row : {std::size_t{0}, std::size_t{1}}) {
    if (entries[row] == MomentumPair::none) continue;
    target += combination[row] * values.segment(at(entries[row]), target.size()).array();
  }
}

}  // namespace

std::unique_ptr<RecombinedKkt> RecombinedKkt::make(const NonlinearProgram& program, std::string& why,
                                                   SegmentKernelChoice choose) {
  const auto entries = interval_entries(program, why);
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
      jacobian_runs_(pattern_runs(program.jacobian_structure())),
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
  softness_.setZero(rows);
  rows_.setZero(rows);
  multiplier_step_.setZero(rows);
  primal_step_.setZero(unknowns);
  momentum_multipliers_.setZero(at(program.constraint_count()));
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
  // First zeros: on the diagonal a row at a left node and one at a right node add to the same entries.
  for (const RecombinedTerm& term : recombined_.terms()) jacobian_.segment(at(term.first), intervals_).setZero();
  for (const RecombinedTerm& term : recombined_.terms()) {
    const Combinations& combinations = combinations_[term.pair];
    const Combination& combination = term.of_right_node ? combinations.right : combinations.left;
    add_combined(combination, jacobian, term.entries, jacobian_.segment(at(term.first), intervals_).array());
  }
  jacobian_.tail(jacobian_.size() - recombined_.first_kept_entry()) = jacobian(recombined_.kept_entries());
}

double RecombinedKkt::combination_operations() const {
  constexpr double of_coefficients = 7.0;  // per pair: two products, a division, four products
  double count = of_coefficients * static_cast<double>(pairs_.size());
  for (const RecombinedTerm& term : recombined_.terms()) {
    for (const std::size_t entry : term.entries) count += entry == MomentumPair::none ? 0.0 : 1.0;
  }
  return count;
}

void RecombinedKkt::combine_rows(const Eigen::VectorXd& rows) {
  rows_.head(recombined_.first_kept_row()).setZero();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    auto of_nodes = rows_.segment(at(i) * (intervals_ + 1), intervals_ + 1).array();
    add_combined(combinations_[i].left, rows, pairs_[i].rows, of_nodes.head(intervals_));
    add_combined(combinations_[i].right, rows, pairs_[i].rows, of_nodes.tail(intervals_));
  }
  rows_.tail(rows_.size() - recombined_.first_kept_row()) = rows(recombined_.kept_rows());
}

/// The slope along a momentum p_k that drops out is balanced by a multiplier of the row with p_k alone, -slope, whose
/// own slope along the other unknowns is added to theirs.
void RecombinedKkt::move_slope(const KktMatrix& matrix, const Eigen::VectorXd& slope) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto of_momenta = slope.segment(at(pairs_[i].momentum) + 1, intervals_ - 1).array();
    for (const std::size_t row : {std::size_t{0}, std::size_t{1}}) {
      momentum_multipliers_.segment(at(pairs_[i].rows[row]) + 1, intervals_ - 1) =
          -combinations_[i].left[row].tail(intervals_ - 1) * of_momenta;
    }
  }
  all_slopes_ = slope;
  add_transposed_product(jacobian_runs_, matrix.jacobian, momentum_multipliers_, all_slopes_);
  slope_ = all_slopes_(recombined_.unknowns());
}

/// From the row with p_k alone, which the steps of all else leave with a residual.
void RecombinedKkt::read_momenta(const Eigen::VectorXd& jacobian, const Eigen::VectorXd& rows,
                                 Eigen::VectorXd& primal_step) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const MomentumPair& pair = pairs_[i];
    scratch_.setZero(intervals_);
    add_combined(combinations_[i].left, rows, pair.rows, scratch_);
    for (const MomentumPair::Column& column : pair.columns) {
      for (const std::size_t row : {std::size_t{0}, std::size_t{1}}) {
        if (column.entries[row] == MomentumPair::none) continue;
        scratch_ += combinations_[i].left[row] * jacobian.segment(at(column.entries[row]), intervals_).array() *
                    primal_step.segment(at(column.unknown), intervals_).array();
      }
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
  const auto& kept = recombined_.kept_rows();
  multiplier_step(kept) = multiplier_step_.tail(at(kept.size()));
}

Verdict RecombinedKkt::solve(const KktMatrix& matrix, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                             Eigen::VectorXd& primal_step, Eigen::VectorXd& multiplier_step) {
  if (!find_combinations(matrix.jacobian)) return Verdict::singular;
  combine_jacobian(matrix.jacobian);
  combine_rows(rows);
  move_slope(matrix, slope);
  diagonal_ = matrix.diagonal(recombined_.unknowns());
  softness_.tail(at(recombined_.kept_rows().size())) = matrix.softness(recombined_.kept_rows());
  const Verdict verdict =
      system_->solve({matrix.hessian, jacobian_, diagonal_, softness_}, slope_, rows_, primal_step_, multiplier_step_);
  if (verdict != Verdict::solved) return verdict;
  primal_step(recombined_.unknowns()) = primal_step_;
  read_momenta(matrix.jacobian, rows, primal_step);
  read_multipliers(slope, multiplier_step);
  return Verdict::solved;
}

}  // namespace dmocbench::interior_point
