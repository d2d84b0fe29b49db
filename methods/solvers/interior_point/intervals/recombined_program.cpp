#include "methods/solvers/interior_point/intervals/recombined_program.hpp"

#include <map>

#include "methods/error.hpp"

namespace dmocbench::interior_point {

namespace {

[[noreturn]] void refuse_evaluation() { throw Error("a recombined program has a structure only"); }

/// The entries of a vector with these numbers.
Eigen::VectorXd picked(const Eigen::VectorXd& vector, const std::vector<Eigen::Index>& numbers) {
  return vector(numbers);
}

}  // namespace

RecombinedProgram::RecombinedProgram(const NonlinearProgram& program, const std::vector<MomentumPair>& pairs)
    : original_(*program.interval_structure()) {
  structure_.intervals = original_.intervals;
  number_unknowns(program, pairs);
  number_rows(program, pairs);
  for (std::size_t number = 0; number < pairs.size(); ++number) append_pair(number, pairs[number]);
  for (std::size_t number = 0; number < pairs.size(); ++number) append_ends(number, pairs[number]);
  append_kept_entries(program.jacobian_structure());
  for (std::size_t e = 0; e < program.hessian_structure().size(); ++e) {
    const auto ours = [&](int unknown) { return number_of_unknown_[static_cast<std::size_t>(unknown)]; };
    hessian_.rows.push_back(ours(program.hessian_structure().rows[e]));
    hessian_.columns.push_back(ours(program.hessian_structure().columns[e]));
  }
}

void RecombinedProgram::number_unknowns(const NonlinearProgram& program, const std::vector<MomentumPair>& pairs) {
  number_of_unknown_.assign(program.variable_count(), 0);
  for (const MomentumPair& pair : pairs) {
    for (std::size_t k = 1; k < original_.intervals; ++k) number_of_unknown_[pair.momentum + k] = -1;
  }
  for (std::size_t i = 0; i < number_of_unknown_.size(); ++i) {
    if (number_of_unknown_[i] < 0) continue;
    number_of_unknown_[i] = static_cast<int>(unknowns_.size());
    unknowns_.push_back(static_cast<Eigen::Index>(i));
    structure_.unknowns.push_back(original_.unknowns[i]);
  }
  variable_lower_ = picked(program.variable_lower(), unknowns_);
  variable_upper_ = picked(program.variable_upper(), unknowns_);
}

void RecombinedProgram::number_rows(const NonlinearProgram& program, const std::vector<MomentumPair>& pairs) {
  number_of_row_.assign(program.constraint_count(), 0);
  for (const MomentumPair& pair : pairs) {
    for (std::size_t k = 0; k < original_.intervals; ++k) {
      for (const std::size_t row : pair.rows) number_of_row_[row + k] = -1;
    }
    for (std::size_t k = 0; k <= original_.intervals; ++k) structure_.rows.push_back({Place::Kind::node, k});
  }
  first_kept_row_ = static_cast<Eigen::Index>(structure_.rows.size());
  for (std::size_t i = 0; i < number_of_row_.size(); ++i) {
    if (number_of_row_[i] < 0) continue;
    number_of_row_[i] = static_cast<int>(structure_.rows.size());
    kept_rows_.push_back(static_cast<Eigen::Index>(i));
    structure_.rows.push_back(original_.rows[i]);
  }
  const auto bounds = [&](const Eigen::VectorXd& of_program) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(structure_.rows.size()));
    all.tail(all.size() - first_kept_row_) = picked(of_program, kept_rows_);
    return all;
  };
  row_lower_ = bounds(program.constraint_lower());
  row_upper_ = bounds(program.constraint_upper());
}

bool RecombinedProgram::is_node(std::size_t unknown) const {
  return original_.unknowns[unknown].kind == Place::Kind::node;
}

void RecombinedProgram::append_entry(std::size_t row, std::size_t unknown) {
  jacobian_.rows.push_back(static_cast<int>(row));
  jacobian_.columns.push_back(number_of_unknown_[unknown]);
}

void RecombinedProgram::append_column(std::size_t row, std::size_t unknown, std::size_t length) {
  for (std::size_t k = 0; k < length; ++k) append_entry(row + k, unknown + k);
}

/// Node k's row reads the unknown of a node at k - 1, k and k + 1, that of an interval at k - 1 and k.
void RecombinedProgram::append_pair(std::size_t number, const MomentumPair& pair) {
  const std::size_t N = original_.intervals;
  const std::size_t first_row = number * (N + 1);
  const auto is_of_first_node = [&](std::size_t unknown) {
    return is_node(unknown) && original_.unknowns[unknown].index == 0;
  };
  std::map<std::size_t, std::size_t> diagonals;  // the first entry of an unknown's, by its number at node 0
  const auto begin_on_diagonal = [&](std::size_t column, bool of_right_node, std::size_t unknown) {
    const auto [found, is_new] = diagonals.try_emplace(unknown, jacobian_.size());
    if (is_new) append_column(first_row, unknown, N + 1);
    terms_.push_back({number, column, of_right_node, !is_new, found->second + (of_right_node ? 1 : 0)});
  };
  const auto begin_beside = [&](std::size_t column, bool of_right_node, std::size_t unknown) {
    terms_.push_back({number, column, of_right_node, false, jacobian_.size()});
    append_column(of_right_node ? first_row + 1 : first_row, unknown, N);
  };
  for (std::size_t column = 0; column < pair.columns.size(); ++column) {
    const std::size_t unknown = pair.columns[column].unknown;
    if (!is_node(unknown)) {
      begin_beside(column, false, unknown);
      begin_beside(column, true, unknown);
    } else if (is_of_first_node(unknown)) {
      begin_on_diagonal(column, false, unknown);
      begin_beside(column, true, unknown);
    } else {
      begin_on_diagonal(column, true, unknown - 1);
      begin_beside(column, false, unknown);
    }
  }
}

void RecombinedProgram::append_ends(std::size_t number, const MomentumPair& pair) {
  const std::size_t N = original_.intervals;
  for (const std::size_t k : {std::size_t{0}, N}) {
    const auto i = static_cast<Eigen::Index>(number_of_unknown_[pair.momentum + k]);
    if (variable_lower_[i] == variable_upper_[i]) continue;
    constants_.push_back({static_cast<Eigen::Index>(jacobian_.size()), k == 0 ? 1.0 : -1.0});
    append_entry(number * (N + 1) + k, pair.momentum + k);
  }
}

void RecombinedProgram::append_kept_entries(const SparsityPattern& jacobian) {
  first_kept_entry_ = static_cast<Eigen::Index>(jacobian_.size());
  for (std::size_t e = 0; e < jacobian.size(); ++e) {
    const int row = number_of_row_[static_cast<std::size_t>(jacobian.rows[e])];
    if (row < 0) continue;
    kept_entries_.push_back(static_cast<Eigen::Index>(e));
    append_entry(static_cast<std::size_t>(row), static_cast<std::size_t>(jacobian.columns[e]));
  }
}

double RecombinedProgram::objective(const VectorIn& /*x*/) { refuse_evaluation(); }
void RecombinedProgram::gradient(const VectorIn& /*x*/, VectorOut /*result*/) { refuse_evaluation(); }
void RecombinedProgram::constraints(const VectorIn& /*x*/, VectorOut /*result*/) { refuse_evaluation(); }
void RecombinedProgram::jacobian(const VectorIn& /*x*/, VectorOut /*values*/) { refuse_evaluation(); }
void RecombinedProgram::hessian(const VectorIn& /*x*/, double /*objective_factor*/, const VectorIn& /*multipliers*/,
                                VectorOut /*values*/) {
  refuse_evaluation();
}

}  // namespace dmocbench::interior_point
