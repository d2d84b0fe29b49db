#include "bench/speed/benchmarked_formulas.hpp"

#include <random>
#include <utility>

#include "methods/expression/replay.hpp"
#include "methods/transcription/element.hpp"
#include "methods/transcription/grid.hpp"
#include "methods/transcription/tableau.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// Numbers around 1: no radius vanishes, and every angle is an ordinary one.
class Numbers {
 public:
  double next() { return distribution_(generator_); }
  Eigen::VectorXd vector(std::size_t size) {
    return Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(size), [this] { return next(); });
  }

 private:
  std::mt19937_64 generator_{1};
  std::uniform_real_distribution<double> distribution_{0.5, 1.5};
};

Grid uneven_grid() {
  Numbers numbers;
  Eigen::VectorXd nodes(static_cast<Eigen::Index>(BenchmarkedFormulas::intervals + 1));
  nodes[0] = 0.0;
  for (Eigen::Index k = 1; k < nodes.size(); ++k) nodes[k] = nodes[k - 1] + numbers.next();
  const double length = nodes[nodes.size() - 1];
  return Grid::from_nodes(nodes / length);
}

std::unique_ptr<Problem> problem_of(const Formulas& formulas) {
  auto problem = make_problem(formulas.problem);
  if (formulas.links > 0) problem->set_parameter("links", formulas.links);
  return problem;
}

/// The outputs of a schedule in this thread's graph, where equal ones are shared.
std::vector<Expression> expressions_of(const Schedule& schedule) {
  std::vector<Expression> inputs;
  for (std::size_t i = 0; i < schedule.input_count(); ++i) inputs.push_back(Expression::input(i));
  return replay<Expression>(schedule, inputs);
}

}  // namespace

BenchmarkedFormulas::BenchmarkedFormulas(Formulas formulas)
    : formulas_(std::move(formulas)),
      program_(*problem_of(formulas_), *make_element(formulas_.method), gauss_tableau(formulas_.stages),
               uneven_grid()) {
  Numbers numbers;
  x_ = numbers.vector(program_.variable_count());
  multipliers_ = numbers.vector(program_.constraint_count());
  const auto bound = program_.bind(x_, multipliers_, objective_factor);
  columns_.assign(bound.begin(), bound.end());
  for (std::size_t k = 0; k < intervals; ++k) {
    for (const Tape::Input& input : columns_) by_interval_.push_back(input.data[input.same_for_all ? 0 : k]);
  }
}

Schedule lagrangian_of(const IntervalFunctions& functions) {
  const LocalInputs& inputs = functions.inputs;
  const std::vector<Expression> constraints = expressions_of(functions.rows.schedule);
  Expression sum = Expression::input(inputs.objective_factor()) * expressions_of(functions.cost).front();
  for (std::size_t r = 0; r < constraints.size(); ++r) {
    sum += Expression::input(inputs.multiplier(functions.rows.places[r])) * constraints[r];
  }
  return Schedule(std::vector<Expression>{sum});
}

Schedule fused(const BenchmarkedFormulas& formulas) {
  std::vector<Expression> all;
  for (const Schedule* part : formulas.schedules()) {
    const std::vector<Expression> outputs = expressions_of(*part);
    all.insert(all.end(), outputs.begin(), outputs.end());
  }
  return Schedule(all);
}

}  // namespace dmocbench::speed
