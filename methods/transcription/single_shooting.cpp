#include "methods/transcription/single_shooting.hpp"

#include <cmath>
#include <limits>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The positions of `numbers` among 0 .. size - 1; -1 where a number is not among them.
std::vector<Eigen::Index> positions(const std::vector<Eigen::Index>& numbers, std::size_t size) {
  std::vector<Eigen::Index> result(size, -1);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    result[static_cast<std::size_t>(numbers[i])] = static_cast<Eigen::Index>(i);
  }
  return result;
}

/// The entries of a sparse matrix whose rows and columns are among those given.
class SubMatrix {
 public:
  SubMatrix(const std::vector<Eigen::Index>& rows, const std::vector<Eigen::Index>& columns, std::size_t row_count,
            std::size_t column_count)
      : rows_(positions(rows, row_count)),
        columns_(positions(columns, column_count)),
        row_count_(std::ssize(rows)),
        column_count_(std::ssize(columns)) {}

  void add(int row, int column, double value) {
    const Eigen::Index i = rows_[static_cast<std::size_t>(row)];
    const Eigen::Index j = columns_[static_cast<std::size_t>(column)];
    if (i >= 0 && j >= 0) entries_.emplace_back(i, j, value);
  }
  [[nodiscard]] Eigen::SparseMatrix<double> matrix() const {
    Eigen::SparseMatrix<double> matrix(row_count_, column_count_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return matrix;
  }

 private:
  std::vector<Eigen::Index> rows_;
  std::vector<Eigen::Index> columns_;
  Eigen::Index row_count_;
  Eigen::Index column_count_;
  std::vector<Eigen::Triplet<double, Eigen::Index>> entries_;
};

}  // namespace

SingleShooting::SingleShooting(Transcription& program)
    : program_(program), interval_(program.functions().rows.schedule), workspace_(interval_) {
  const ProgramBlocks& blocks = program.blocks();
  if (blocks.unknown(Quantity::integral).width > 0)
    throw Error("single shooting does not support integral constraints; use multiple_shooting");
  if (program.functions().has_stage_unknowns || blocks.unknown(Quantity::cost).width > 0) {
    throw Error("single shooting supports only programs of multiple shooting in Bolza form");
  }
  sort_unknowns();
  sort_rows();
  const Eigen::Index entries = std::ssize(simulated_) * std::ssize(kept_);
  if (entries > most_entries) {
    throw Error(
        "single shooting keeps a dense matrix of {} states by {} unknowns, which may have at most {} "
        "entries; use fewer intervals, or multiple_shooting",
        simulated_.size(), kept_.size(), most_entries);
  }
  set_structures();
  outputs_.resize(program.grid().relative_widths().size(), static_cast<Eigen::Index>(interval_.output_count()));
}

void SingleShooting::sort_unknowns() {
  const ProgramBlocks& blocks = program_.blocks();
  const auto intervals = static_cast<Eigen::Index>(blocks.intervals());
  // Entry k of every series of two blocks.
  const auto add = [](const auto& first, const auto& second, Eigen::Index k, std::vector<Eigen::Index>& numbers) {
    for (const auto* block : {&first, &second}) {
      for (Eigen::Index i = 0; i < block->width; ++i) numbers.push_back(block->index(i) + k);
    }
  };
  for (Eigen::Index k = 0; k < intervals; ++k) {
    add(blocks.unknown(Quantity::configuration), blocks.unknown(Quantity::second), k + 1, simulated_);
    add(blocks.row(Equation::motion), blocks.row(Equation::second_motion), k, equations_);
  }
  const auto is_simulated = positions(simulated_, program_.variable_count());
  for (std::size_t i = 0; i < program_.variable_count(); ++i) {
    if (is_simulated[i] < 0) kept_.push_back(static_cast<Eigen::Index>(i));
  }
}

void SingleShooting::sort_rows() {
  const auto is_equation = positions(equations_, program_.constraint_count());
  for (std::size_t i = 0; i < program_.constraint_count(); ++i) {
    if (is_equation[i] < 0) rows_.push_back(static_cast<Eigen::Index>(i));
  }
  const Eigen::VectorXd lower = of_states(program_.variable_lower());
  const Eigen::VectorXd upper = of_states(program_.variable_upper());
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (std::isfinite(lower[i]) || std::isfinite(upper[i])) bounded_.push_back(i);
  }
  variable_lower_ = program_.variable_lower()(kept_);
  variable_upper_ = program_.variable_upper()(kept_);
  const auto count = static_cast<Eigen::Index>(constraint_count());
  constraint_lower_.resize(count);
  constraint_upper_.resize(count);
  constraint_lower_ << lower(bounded_), program_.constraint_lower()(rows_);
  constraint_upper_ << upper(bounded_), program_.constraint_upper()(rows_);
}

void SingleShooting::set_structures() {
  const auto variables = static_cast<Eigen::Index>(variable_count());
  const auto constraints = static_cast<Eigen::Index>(constraint_count());
  for (Eigen::Index i = 0; i < constraints; ++i) {
    jacobian_structure_.append({.row = i, .column = 0, .row_step = 0, .column_step = 1, .length = variables});
  }
  for (Eigen::Index d = 0; d < variables; ++d) {  // diagonal by diagonal
    hessian_structure_.append({.row = d, .column = 0, .row_step = 1, .column_step = 1, .length = variables - d});
  }
}

void SingleShooting::simulate(const VectorIn& x) {
  if (simulated_from_.size() == x.size() && simulated_from_ == x) return;
  simulated_from_ = x;
  const Eigen::Index n = program_.traced_problem().configuration_size();
  const Eigen::VectorXd no_multipliers;
  primal_.setZero(static_cast<Eigen::Index>(program_.variable_count()));
  primal_(kept_) = x;
  const Eigen::VectorXd steps = program_.steps(primal_);
  std::vector<double*> columns;
  for (auto column : outputs_.colwise()) columns.push_back(column.data());
  const auto inputs = program_.bind(primal_, no_multipliers, 1.0);
  for (Eigen::Index k = 0; k < steps.size(); ++k) {
    const auto interval = static_cast<std::size_t>(k);
    interval_.evaluate(interval, interval + 1, inputs, columns, workspace_);
    for (std::size_t e = 0; e < columns.size(); ++e) {
      const auto row = static_cast<Eigen::Index>(program_.functions().rows.places[e]);
      if (row >= 2 * n) continue;  // a path constraint
      // The row is (x_{k+1} - Φ)/h at x_{k+1} = 0.
      primal_[simulated_[static_cast<std::size_t>(2 * n * k + row)]] = -steps[k] * columns[e][interval];
    }
  }
  is_defined_ = primal_.allFinite();
}

void SingleShooting::linearise(const VectorIn& x) {
  simulate(x);
  if (!is_defined_) return;
  if (linearised_at_.size() == x.size() && linearised_at_ == x) return;
  linearised_at_ = x;
  const BlockPattern& pattern = program_.jacobian_structure();
  Eigen::VectorXd values(static_cast<Eigen::Index>(pattern.size()));
  program_.jacobian(primal_, values);
  gradient_.resize(primal_.size());
  program_.gradient(primal_, gradient_);
  const std::size_t constraints = program_.constraint_count();
  const std::size_t variables = program_.variable_count();
  SubMatrix states(equations_, simulated_, constraints, variables);
  SubMatrix controls(equations_, kept_, constraints, variables);
  SubMatrix rows_by_states(rows_, simulated_, constraints, variables);
  SubMatrix rows_by_controls(rows_, kept_, constraints, variables);
  pattern.for_each([&](Eigen::Index entry, int row, int column) {
    for (SubMatrix* part : {&states, &controls, &rows_by_states, &rows_by_controls}) {
      part->add(row, column, values[entry]);
    }
  });
  states_ = states.matrix();
  controls_ = controls.matrix();
  rows_by_states_ = rows_by_states.matrix();
  rows_by_controls_ = rows_by_controls.matrix();
  sensitivities_ = states_.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd(-controls_));
}

Eigen::VectorXd SingleShooting::adjoint(double objective_factor, const VectorIn& multipliers) {
  Eigen::VectorXd right_hand_side = -objective_factor * of_states(gradient_);
  right_hand_side(bounded_) -= multipliers.head(std::ssize(bounded_));
  right_hand_side -= rows_by_states_.transpose() * multipliers.tail(std::ssize(rows_));
  const Eigen::VectorXd of_equations = states_.transpose().triangularView<Eigen::Upper>().solve(right_hand_side);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program_.constraint_count()));
  all(equations_) = of_equations;
  all(rows_) = multipliers.tail(std::ssize(rows_));
  return all;
}

bool SingleShooting::is_undefined(VectorOut values) const {
  if (!is_defined_) values.setConstant(not_a_number);
  return !is_defined_;
}

double SingleShooting::objective(const VectorIn& x) {
  simulate(x);
  return is_defined_ ? program_.objective(primal_) : not_a_number;
}

void SingleShooting::gradient(const VectorIn& x, VectorOut result) {
  linearise(x);
  if (is_undefined(result)) return;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(constraint_count()));
  const Eigen::VectorXd multipliers = adjoint(1.0, none);
  result = gradient_(kept_) + controls_.transpose() * Eigen::VectorXd(multipliers(equations_));
}

void SingleShooting::constraints(const VectorIn& x, VectorOut result) {
  simulate(x);
  if (is_undefined(result)) return;
  Eigen::VectorXd all(static_cast<Eigen::Index>(program_.constraint_count()));
  program_.constraints(primal_, all);
  result << of_states(primal_)(bounded_), all(rows_);
}

void SingleShooting::jacobian(const VectorIn& x, VectorOut values) {
  linearise(x);
  if (is_undefined(values)) return;
  const Eigen::MatrixXd of_bounds = sensitivities_(bounded_, Eigen::all);
  const Eigen::MatrixXd of_rows = Eigen::MatrixXd(rows_by_controls_) + rows_by_states_ * sensitivities_;
  const auto width = static_cast<Eigen::Index>(variable_count());
  const auto write = [&](Eigen::Index first, const Eigen::MatrixXd& rows) {
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      values.segment((first + i) * width, width) = rows.row(i).transpose();
    }
  };
  write(0, of_bounds);
  write(of_bounds.rows(), of_rows);
}

void SingleShooting::hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers,
                             VectorOut values) {
  linearise(x);
  if (is_undefined(values)) return;
  const BlockPattern& pattern = program_.hessian_structure();
  Eigen::VectorXd entries(static_cast<Eigen::Index>(pattern.size()));
  program_.hessian(primal_, objective_factor, adjoint(objective_factor, multipliers), entries);
  // Z in the order of multiple shooting.
  const auto width = static_cast<Eigen::Index>(variable_count());
  Eigen::MatrixXd z(primal_.size(), width);
  z(kept_, Eigen::all).setIdentity();
  z(simulated_, Eigen::all) = sensitivities_;
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(primal_.size(), width);
  pattern.for_each([&](Eigen::Index entry, int row, int column) {
    product.row(row) += entries[entry] * z.row(column);
    if (row != column) product.row(column) += entries[entry] * z.row(row);
  });
  const Eigen::MatrixXd condensed = z.transpose() * product;
  Eigen::Index entry = 0;
  for (Eigen::Index d = 0; d < width; ++d) {
    values.segment(entry, width - d) = condensed.diagonal(-d);
    entry += width - d;
  }
}

Eigen::VectorXd SingleShooting::reduced(const Eigen::VectorXd& primal) const { return primal(kept_); }

Solution SingleShooting::expanded(Solution solution) {
  if (solution.primal.size() == 0) return solution;
  const Eigen::VectorXd x = solution.primal;
  linearise(x);
  solution.primal = primal_;
  if (!is_defined_) {
    solution.multipliers.resize(0);
  } else if (solution.multipliers.size() > 0) {
    solution.multipliers = adjoint(1.0, solution.multipliers);
  }
  return solution;
}

}  // namespace dmocbench
