#include "methods/mechanics/traced_problem.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/mechanics/column_names.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/mechanics/point_of_inputs.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

void require_size(Eigen::Index actual, Eigen::Index wanted, const Problem& problem, const char* formula) {
  if (actual == wanted) return;
  throw Error("{}: {} has {}, expected {}", problem.name(), formula, counted(actual, "entry", "entries"), wanted);
}

/// Constraints have names all or none.
void require_as_many_names(const std::vector<std::string>& names, Eigen::Index entries, const Problem& problem,
                           const char* formula) {
  if (!names.empty()) require_size(std::ssize(names), entries, problem, formula);
}

/// Whether formulas read one of `count` inputs from `first` on.
bool reads(const Schedule& formulas, std::size_t first, std::size_t count) {
  return std::ranges::any_of(formulas.steps(), [&](const Schedule::Step& step) {
    return step.operation == Operation::input && step.input_index >= first && step.input_index < first + count;
  });
}

/// A control that nothing reads would keep any value. `first` is the input of the first control.
void require_controls(const Schedule& formulas, std::size_t first, const Problem& problem) {
  const std::vector<std::string> names = problem.control_names();
  std::vector<bool> is_read(names.size());
  for (const Schedule::Step& step : formulas.steps()) {
    if (step.operation != Operation::input || step.input_index < first) continue;
    if (step.input_index - first < is_read.size()) is_read[step.input_index - first] = true;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!is_read[i]) throw Error(problem.name() + ": no formula depends on the control " + names[i] + "; remove it");
  }
}

/// Substitutes other formulas for the inputs of a schedule, and reads its outputs in their order.
class FormulaReader {
 public:
  FormulaReader(const Schedule& schedule, std::initializer_list<const ExpressionVector*> parts,
                const Expression& time) {
    std::vector<Expression> inputs;
    for (const ExpressionVector* part : parts) inputs.insert(inputs.end(), part->begin(), part->end());
    inputs.push_back(time);
    formulas_ = replay<Expression>(schedule, inputs);
  }
  Expression scalar() { return formulas_[next_++]; }
  ExpressionMatrix matrix(Eigen::Index rows, Eigen::Index columns) {
    ExpressionMatrix result(rows, columns);
    for (Expression& entry : result.reshaped()) entry = scalar();
    return result;
  }
  ExpressionVector vector(Eigen::Index rows) { return matrix(rows, 1); }

 private:
  std::vector<Expression> formulas_;
  std::size_t next_ = 0;
};

}  // namespace

TracedProblem::TracedProblem(const Problem& problem, const std::vector<std::string>& open_parameters)
    : n_(call_formula(problem, "configuration_names", [&] { return problem.configuration_size(); })),
      m_(call_formula(problem, "control_names", [&] { return problem.control_size(); })),
      l_(call_formula(problem, "first_order_names", [&] { return problem.first_order_size(); })) {
  require_names(problem);
  const Eigen::VectorXd values = parameter_values(problem);
  const ProblemCard card = call_formula(problem, "card", [&] {
    return problem.card();
  });  // before the trace: parameters that it reads are not constants of formulas
  const ParameterTrace parameters(problem, open_parameters);
  open_ = parameters.open();
  unknowns_ = problem.unknowns();
  open_.resize(open_.size() - unknowns_.size());
  open_values_.resize(static_cast<Eigen::Index>(open_.size()));
  unknown_values_.resize(static_cast<Eigen::Index>(unknowns_.size()));
  set_parameters(values);
  trace_constraints(problem);
  trace_formulas(problem);
  trace_ends(problem);
  if (const Problem* const redundant = problem.redundant(); redundant != nullptr) {
    InputCounter node;
    const ExpressionVector theta = node.take(n_);
    embedding_ = Schedule(redundant->moving_embedding(theta, node.take()));
    of_stages_ = std::make_shared<const TracedProblem>(*redundant);
  }
  parameters.require_unknowns_read();
  require_as_many_names(card.path_constraint_names, path_constraints_, problem, "path_constraint_names");
  require_as_many_names(card.boundary_condition_names, boundary_conditions_, problem, "boundary_condition_names");
  are_constants_ = parameters.are_constants();
  const std::vector<bool> varying = parameters.are_varying();
  for (std::size_t i = 0; i < varying.size(); ++i) {
    if (varying[i]) varying_.push_back(problem.parameters()[i].name);
  }
}

void TracedProblem::trace_formulas(const Problem& problem) {
  InputCounter inputs(parameter_inputs());
  const ControlledState point = take_point(inputs, n_, m_, l_);
  const Expression lagrangian = call_formula(problem, "lagrangian", [&] { return problem.lagrangian(point.state()); });
  const ExpressionVector force = call_formula(problem, "force", [&] { return problem.force(point); });
  require_size(force.size(), n_, problem, "force");
  const ExpressionVector rates =
      call_formula(problem, "first_order_rates", [&] { return problem.first_order_rates(point); });
  require_size(rates.size(), l_, problem, "first_order_rates");

  const ExpressionVector momentum = gradient(lagrangian, point.v);
  const ExpressionMatrix mass = jacobian(momentum, point.v);
  const auto is_zero = [](const Expression& entry) { return entry.is_zero(); };
  for (Eigen::Index i = 0; i < n_ && constraint_count_ == 0; ++i) {
    const auto row = mass.row(i);
    if (std::all_of(row.begin(), row.end(), is_zero)) {
      throw Error(problem.name() + ": the Lagrangian is not regular: L_vv has a zero row for " +
                  problem.configuration_names()[static_cast<std::size_t>(i)]);
    }
  }
  const ExpressionVector configuration_force = gradient(lagrangian, point.q);

  std::vector<Expression> formulas;
  append(formulas, momentum);
  append(formulas, configuration_force);
  append(formulas, force);
  formulas.push_back(call_formula(problem, "running_cost", [&] { return problem.running_cost(point); }));
  const ExpressionVector path_constraints =
      call_formula(problem, "path_constraints", [&] { return problem.path_constraints(point); });
  path_constraints_ = path_constraints.size();
  for (const Expression& entry : path_constraints) {
    constraints_read_controls_.push_back(reads(Schedule(std::span(&entry, 1)),
                                               parameter_inputs() + 2 * static_cast<std::size_t>(n_),
                                               static_cast<std::size_t>(m_)));
  }
  append(formulas, path_constraints);
  append(formulas, mass);
  append(formulas, jacobian(momentum, point.q));
  const ExpressionVector momentum_by_time = jacobian(momentum, ExpressionVector::Constant(1, point.t));
  momentum_depends_on_time_ = !std::all_of(momentum_by_time.begin(), momentum_by_time.end(), is_zero);
  momentum_depends_on_unknowns_ = reads(Schedule(momentum), open_.size(), unknowns_.size());
  append(formulas, momentum_by_time);
  append(formulas, rates);
  const ExpressionMatrix momentum_by_first_order = jacobian(momentum, point.y);
  momentum_depends_on_first_order_ = !std::ranges::all_of(momentum_by_first_order.reshaped(), is_zero);
  append(formulas, momentum_by_first_order);
  const ExpressionVector integrands = call_formula(problem, "integrands", [&] { return problem.integrands(point); });
  integrals_ = integrands.size();
  append(formulas, integrands);
  if (const auto generator = call_formula(problem, "symmetry", [&] { return problem.symmetry(point.q); })) {
    require_size(generator->size(), n_, problem, "symmetry");
    has_symmetry_ = true;
    append(formulas, *generator);
    append(formulas, jacobian(*generator, point.q));
  }
  schedule_ = Schedule(formulas);
  require_controls(schedule_, parameter_inputs() + 2 * static_cast<std::size_t>(n_), problem);
  tape_ = Tape(schedule_);
}

void TracedProblem::trace_constraints(const Problem& problem) {
  InputCounter inputs(parameter_inputs());
  const ExpressionVector q = inputs.take(n_);
  const ExpressionVector v = inputs.take(n_);
  const ExpressionVector residual = call_formula(problem, "constraints", [&] { return problem.constraints(q); });
  const ExpressionVector rates =
      call_formula(problem, "velocity_constraints", [&] { return problem.velocity_constraints(q, v); });
  holonomic_count_ = residual.size();
  constraint_count_ = residual.size() + rates.size();
  if (constraint_count_ == 0) return;
  if (constraint_count_ >= n_) {
    throw Error("{}: {} no degree of freedom for {}; state fewer constraints", problem.name(),
                counted(constraint_count_, "constraint leaves", "constraints leave"), counted(n_, "coordinate"));
  }
  for (Eigen::Index i = 0; i < holonomic_count_; ++i) {
    if (reads(Schedule(residual.segment(i, 1)), parameter_inputs(), static_cast<std::size_t>(n_))) continue;
    throw Error("{}: constraints[{}] depends on no coordinate", problem.name(), i);
  }
  ExpressionMatrix by_v(constraint_count_, n_);
  by_v.topRows(holonomic_count_) = jacobian(residual, q);
  by_v.bottomRows(rates.size()) = jacobian(rates, v);
  require_linear(rates, by_v.bottomRows(rates.size()), problem);
  std::vector<Expression> formulas;
  append(formulas, residual);
  append(formulas, by_v);
  append(formulas, jacobian(by_v * v, q) * v);
  constraints_ = Schedule(formulas);
}

void TracedProblem::require_linear(const ExpressionVector& rates, const ExpressionMatrix& by_v,
                                   const Problem& problem) const {
  const ExpressionVector parameters = input_vector(0, static_cast<Eigen::Index>(parameter_inputs()));
  const ExpressionVector q = input_vector(parameter_inputs(), n_);
  const ExpressionVector rest(n_);
  const ExpressionVector at_rest = FormulaReader(Schedule(rates), {&parameters, &q, &rest}, {}).vector(rates.size());
  const auto size = static_cast<std::size_t>(n_);
  for (Eigen::Index i = 0; i < rates.size(); ++i) {
    const Schedule row(ExpressionVector(by_v.row(i).transpose()));
    const bool is_linear = at_rest[i].is_zero() && !reads(row, parameter_inputs() + size, size);
    const auto is_zero = [](const Expression& entry) { return entry.is_zero(); };
    if (is_linear && !std::ranges::all_of(by_v.row(i), is_zero)) continue;
    throw Error(
        "{}: velocity_constraints[{}] is not linear in v; state the entries of A(q) v, which vanish "
        "at v = 0",
        problem.name(), i);
  }
}

void TracedProblem::require_no_constraints(const char* method) const {
  if (constraint_count_ == 0 && !has_embedding()) return;
  if (holonomic_count_ == 0 && !has_embedding()) {
    throw Error("{} does not support velocity constraints ({}); state the problem in quasi-velocities", method,
                member_name("Problem::velocity_constraints"));
  }
  throw Error("{} does not support {} g(q) = 0 ({}); state the problem in minimal coordinates", method,
              has_embedding() ? "the embedding of constraints" : "constraints",
              has_embedding() ? std::string("EmbeddedProblem") : member_name("Problem::constraints"));
}

TracedProblem::ConstraintValues TracedProblem::constraints_at(const ExpressionVector& q,
                                                              const ExpressionVector& v) const {
  const ExpressionVector parameters = this->parameters();
  FormulaReader read(constraints_, {&parameters, &q, &v}, {});
  ConstraintValues values;
  values.residual = read.vector(holonomic_count_);
  values.jacobian = read.matrix(constraint_count_, n_);
  values.curvature = read.vector(constraint_count_);
  return values;
}

ExpressionVector TracedProblem::in_stages(const ExpressionVector& q, const Expression& t) const {
  if (!has_embedding()) return q;
  return FormulaReader(embedding_, {&q}, t).vector(of_stages_->configuration_size());
}

void TracedProblem::trace_ends(const Problem& problem) {
  InputCounter inputs(parameter_inputs());
  const State first{inputs.take(n_), inputs.take(n_), Expression(0.0), inputs.take(l_)};
  State last{inputs.take(n_), inputs.take(n_), {}, inputs.take(l_)};
  last.t = inputs.take();
  const ExpressionVector conditions =
      call_formula(problem, "boundary_conditions", [&] { return problem.boundary_conditions(first, last); });
  boundary_conditions_ = conditions.size();
  std::vector<Expression> formulas;
  append(formulas, conditions);
  formulas.push_back(call_formula(problem, "final_cost", [&] { return problem.final_cost(last); }));
  ends_ = Schedule(formulas);
}

bool TracedProblem::ends_read(Eigen::Index first, Eigen::Index count) const {
  return reads(ends_, parameter_inputs() + static_cast<std::size_t>(first), static_cast<std::size_t>(count));
}

void TracedProblem::set_parameters(const Eigen::VectorXd& values) {
  for (std::size_t i = 0; i < open_.size(); ++i) {
    open_values_[static_cast<Eigen::Index>(i)] = values[static_cast<Eigen::Index>(open_[i])];
  }
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    unknown_values_[static_cast<Eigen::Index>(i)] = values[static_cast<Eigen::Index>(unknowns_[i])];
  }
}

TracedProblem TracedProblem::with_open_inputs(const ExpressionVector& unknowns) const {
  TracedProblem open = *this;
  open.has_open_inputs_ = true;
  open.unknown_inputs_ = unknowns;
  return open;
}

ExpressionVector TracedProblem::parameters() const {
  ExpressionVector all(open_values_.size() + unknown_values_.size());
  if (has_open_inputs_) {
    all << input_vector(0, open_values_.size()), unknown_inputs_;
  } else {
    all << open_values_.cast<Expression>(), unknown_values_.cast<Expression>();
  }
  return all;
}

void TracedProblem::require_first_order(Eigen::Index given) const {
  if (given == l_) return;
  throw Error("this method does not support first-order states ({}); choose dmoc, hamiltonian, tangent or galerkin",
              member_name("Problem::first_order_names"));
}

Eigen::MatrixXd TracedProblem::table(std::span<const MotionPoint> points, const Eigen::VectorXd& times) const {
  Eigen::MatrixXd rows(times.size(), 2 * n_ + m_ + l_ + 1);
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    const MotionPoint& point = points[static_cast<std::size_t>(i)];
    rows.row(i) << point.q.transpose(), point.v.transpose(), point.u.transpose(), point.y.transpose(), times[i];
  }
  return table(rows);
}

Eigen::MatrixXd TracedProblem::table(const Eigen::MatrixXd& rows) const {
  std::vector<Tape::Input> columns;
  for (const double& value : open_values_) columns.push_back({&value, true});
  for (const double& value : unknown_values_) columns.push_back({&value, true});
  for (const auto& column : rows.colwise()) columns.push_back({column.data(), false});
  return tape_.table(rows.rows(), columns);
}

TracedProblem::EndValues TracedProblem::at_ends(const State& first, const State& last) const {
  const ExpressionVector parameters = this->parameters();
  require_first_order(first.y.size());
  require_first_order(last.y.size());
  FormulaReader read(ends_, {&parameters, &first.q, &first.v, &first.y, &last.q, &last.v, &last.y}, last.t);
  EndValues values;
  values.conditions = read.vector(boundary_conditions_);
  values.final_cost = read.scalar();
  return values;
}

TracedProblem::Values TracedProblem::at(const ControlledState& point) const {
  const ExpressionVector parameters = this->parameters();
  require_first_order(point.y.size());
  FormulaReader read(schedule_, {&parameters, &point.q, &point.v, &point.u, &point.y}, point.t);
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
  values.first_order_rates = read.vector(l_);
  values.momentum_by_first_order = read.matrix(n_, l_);
  values.integrands = read.vector(integrals_);
  if (has_symmetry_) {
    values.symmetry = read.vector(n_);
    values.symmetry_jacobian = read.matrix(n_, n_);
  }
  return values;
}

TracedProblem::Values TracedProblem::at(const State& point) const {
  return at(ControlledState{point.q, point.v, ExpressionVector(m_), point.t, point.y});
}

}  // namespace dmocbench
