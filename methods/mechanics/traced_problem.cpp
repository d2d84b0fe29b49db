#include "methods/mechanics/traced_problem.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"

namespace dmocbench {

namespace {

void require_size(Eigen::Index actual, Eigen::Index wanted, const Problem& problem, const char* what) {
  if (actual == wanted) return;
  throw Error(fmt::format("{}: {} has {} entries, expected {}", problem.name(), what, actual, wanted));
}

/// A list of formulas that `FormulaReader` reads back in the same order.
class FormulaList {
 public:
  void append(const Expression& formula) { formulas_.push_back(formula); }
  template <class Derived>
  void append(const Eigen::DenseBase<Derived>& formulas) {
    for (Eigen::Index j = 0; j < formulas.cols(); ++j) {
      for (Eigen::Index i = 0; i < formulas.rows(); ++i) formulas_.push_back(formulas(i, j));
    }
  }
  [[nodiscard]] const std::vector<Expression>& formulas() const { return formulas_; }

 private:
  std::vector<Expression> formulas_;
};

/// Reads formulas back in the order in which they were appended.
class FormulaReader {
 public:
  explicit FormulaReader(const std::vector<Expression>& formulas) : formulas_(&formulas) {}
  Expression scalar() { return (*formulas_)[next_++]; }
  ExpressionMatrix matrix(Eigen::Index rows, Eigen::Index columns) {
    ExpressionMatrix result(rows, columns);
    for (Eigen::Index j = 0; j < columns; ++j) {
      for (Eigen::Index i = 0; i < rows; ++i) result(i, j) = scalar();
    }
    return result;
  }
  ExpressionVector vector(Eigen::Index rows) { return matrix(rows, 1); }

 private:
  const std::vector<Expression>* formulas_;
  std::size_t next_ = 0;
};

}  // namespace

TracedProblem::TracedProblem(const Problem& problem) : n_(problem.configuration_size()), m_(problem.control_size()) {
  if (n_ == 0) throw Error(problem.name() + ": configuration_names is empty; a problem needs a configuration");
  const auto n = static_cast<std::size_t>(n_);
  const auto m = static_cast<std::size_t>(m_);
  const ControlledState point{input_vector(0, n_), input_vector(n, n_), input_vector(2 * n, m_),
                              Expression::input(2 * n + m)};
  const Expression lagrangian = problem.lagrangian(point.state());
  const ExpressionVector force = problem.force(point);
  require_size(force.size(), n_, problem, "force");

  const ExpressionVector momentum = gradient(lagrangian, point.v);
  const ExpressionMatrix mass = jacobian(momentum, point.v);
  for (Eigen::Index i = 0; i < n_; ++i) {
    bool depends = false;
    for (Eigen::Index j = 0; j < n_; ++j) depends = depends || !mass(i, j).is_zero();
    if (!depends) {
      throw Error(problem.name() + ": the Lagrangian is not regular, L_vv has an empty row for " +
                  problem.configuration_names()[static_cast<std::size_t>(i)]);
    }
  }
  const ExpressionVector configuration_force = gradient(lagrangian, point.q);

  FormulaList list;
  list.append(momentum);
  list.append(configuration_force);
  list.append(force);
  list.append(problem.running_cost(point));
  const ExpressionVector path_constraints = problem.path_constraints(point);
  path_constraints_ = path_constraints.size();
  list.append(path_constraints);
  list.append(mass);
  list.append(jacobian(momentum, point.q));
  ExpressionVector time(1);
  time << point.t;
  const ExpressionMatrix momentum_by_time = jacobian(momentum, time);
  for (const Expression& entry : momentum_by_time.reshaped()) {
    momentum_depends_on_time_ = momentum_depends_on_time_ || !entry.is_zero();
  }
  list.append(momentum_by_time);
  if (const auto generator = problem.symmetry(point.q)) {
    require_size(generator->size(), n_, problem, "symmetry");
    has_symmetry_ = true;
    list.append(*generator);
    list.append(jacobian(*generator, point.q));
  }
  schedule_ = Schedule(list.formulas());
  tape_ = Tape(schedule_);
  trace_ends(problem);
}

void TracedProblem::trace_ends(const Problem& problem) {
  const auto n = static_cast<std::size_t>(n_);
  const State first{input_vector(0, n_), input_vector(n, n_), Expression(0.0)};
  const State last{input_vector(2 * n, n_), input_vector(3 * n, n_), Expression::input(4 * n)};
  const ExpressionVector conditions = problem.boundary_conditions(first, last);
  boundary_conditions_ = conditions.size();
  FormulaList list;
  list.append(conditions);
  list.append(problem.final_cost(last));
  ends_ = Schedule(list.formulas());
}

Eigen::MatrixXd TracedProblem::table(std::span<const MotionPoint> points, const Eigen::VectorXd& times) const {
  Eigen::MatrixXd inputs(times.size(), 2 * n_ + m_ + 1);
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    const MotionPoint& point = points[static_cast<std::size_t>(i)];
    inputs.row(i) << point.q.transpose(), point.v.transpose(), point.u.transpose(), times[i];
  }
  Eigen::MatrixXd values(times.size(), static_cast<Eigen::Index>(tape_.output_count()));
  std::vector<Tape::Input> columns;
  std::vector<double*> results;
  for (const auto& column : inputs.colwise()) columns.push_back({column.data(), false});
  for (auto column : values.colwise()) results.push_back(column.data());
  Tape::Workspace workspace(tape_);
  tape_.evaluate(points.size(), columns, results, workspace);
  return values;
}

TracedProblem::EndValues TracedProblem::at_ends(const State& first, const State& last) const {
  std::vector<Expression> inputs;
  for (const ExpressionVector* part : {&first.q, &first.v, &last.q, &last.v}) {
    inputs.insert(inputs.end(), part->begin(), part->end());
  }
  inputs.push_back(last.t);
  const std::vector<Expression> formulas = replay<Expression>(ends_, inputs);
  FormulaReader read(formulas);
  EndValues values;
  values.conditions = read.vector(boundary_conditions_);
  values.final_cost = read.scalar();
  return values;
}

TracedProblem::Values TracedProblem::at(const ControlledState& point) const {
  std::vector<Expression> inputs;
  for (const ExpressionVector* part : {&point.q, &point.v, &point.u}) {
    inputs.insert(inputs.end(), part->begin(), part->end());
  }
  inputs.push_back(point.t);
  const std::vector<Expression> formulas = replay<Expression>(schedule_, inputs);
  FormulaReader read(formulas);
  Values values;
  values.momentum = read.vector(n_);
  values.configuration_force = read.vector(n_);
  values.control_force = read.vector(n_);
  values.generalised_force = values.configuration_force + values.control_force;
  values.running_cost = read.scalar();
  values.path_constraints = read.vector(path_constraints_);
  values.mass = read.matrix(n_, n_);
  values.momentum_by_configuration = read.matrix(n_, n_);
  values.momentum_by_time = read.vector(n_);
  if (has_symmetry_) {
    values.symmetry = read.vector(n_);
    values.symmetry_jacobian = read.matrix(n_, n_);
  }
  return values;
}

TracedProblem::Values TracedProblem::at(const State& point) const {
  return at(ControlledState{point.q, point.v, ExpressionVector(m_), point.t});
}

}  // namespace dmocbench
