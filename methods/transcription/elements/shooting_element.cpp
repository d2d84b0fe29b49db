#include "methods/transcription/elements/shooting_element.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/expression/vectors.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

ExplicitIntegrator classical() {
  ExplicitIntegrator method{"rk4", Eigen::MatrixXd::Zero(4, 4), Eigen::Vector4d(1, 2, 2, 1) / 6.0,
                            Eigen::Vector4d(0.0, 0.5, 0.5, 1.0), 4};
  method.a(1, 0) = 0.5;
  method.a(2, 1) = 0.5;
  method.a(3, 2) = 1.0;
  return method;
}

ExplicitIntegrator midpoint() {
  ExplicitIntegrator method{"midpoint", Eigen::MatrixXd::Zero(2, 2), Eigen::Vector2d(0.0, 1.0),
                            Eigen::Vector2d(0.0, 0.5), 2};
  method.a(1, 0) = 0.5;
  return method;
}

const std::array<ExplicitIntegrator, 2>& integrators() {
  static const std::array<ExplicitIntegrator, 2> table{classical(), midpoint()};
  return table;
}

}  // namespace

std::vector<std::string> explicit_integrator_names() { return names_of(integrators(), &ExplicitIntegrator::name); }

const ExplicitIntegrator& explicit_integrator(std::string_view name) {
  return one_of(integrators(), &ExplicitIntegrator::name, name, "there is no integrator");
}

namespace {

/// State and cost along an interval, or their rates.
struct Flow {
  ExpressionVector q;
  ExpressionVector v;
  Expression cost;
};

/// The equations of motion with a control that is a polynomial of time.
class ControlledFlow {
 public:
  ControlledFlow(const TracedProblem& problem, const Tableau& tableau, const IntervalUnknowns& unknowns)
      : problem_(&problem), tableau_(&tableau), unknowns_(&unknowns) {}

  /// At the time `tau` relative to the interval.
  [[nodiscard]] ExpressionVector control(double tau) const {
    return polynomial_at(tableau_->c, unknowns_->controls, tau);
  }

  [[nodiscard]] Flow rate(const Flow& at, double tau) const {
    const Expression t = unknowns_->t + Expression(tau) * unknowns_->h;
    const TracedProblem::Values values = problem_->at(ControlledState{at.q, at.v, control(tau), t});
    ExpressionVector force = values.generalised_force - values.momentum_by_time;
    force -= values.momentum_by_configuration * at.v;
    return {at.v, solve_symmetric(values.mass, force), values.running_cost};
  }

 private:
  const TracedProblem* problem_;
  const Tableau* tableau_;
  const IntervalUnknowns* unknowns_;
};

void add(Flow& sum, const Expression& factor, const Flow& rate) {
  sum.q += factor * rate.q;
  sum.v += factor * rate.v;
  sum.cost += factor * rate.cost;
}

/// One step of length `h` that begins at the relative time `first` and takes `width` of the interval.
Flow advance(const ControlledFlow& flow, const ExplicitIntegrator& method, const Flow& at, const Expression& h,
             double first, double width) {
  std::vector<Flow> rates;
  for (Eigen::Index i = 0; i < method.stages(); ++i) {
    Flow stage = at;
    for (Eigen::Index j = 0; j < i; ++j) add(stage, h * Expression(method.a(i, j)), rates[static_cast<std::size_t>(j)]);
    rates.push_back(flow.rate(stage, first + method.c[i] * width));
  }
  Flow next = at;
  for (Eigen::Index i = 0; i < method.stages(); ++i) {
    add(next, h * Expression(method.b[i]), rates[static_cast<std::size_t>(i)]);
  }
  return next;
}

/// The point at `theta` in [0, 1] on the cubic through both ends of a step of length `h` with their velocities.
State on_cubic(const Flow& left, const Flow& right, const Expression& h, double theta) {
  const double square = theta * theta;
  const double cube = square * theta;
  State state;
  state.q = Expression(2.0 * cube - 3.0 * square + 1.0) * left.q + Expression(3.0 * square - 2.0 * cube) * right.q;
  state.q += (h * Expression(cube - 2.0 * square + theta)) * left.v + (h * Expression(cube - square)) * right.v;
  state.v = (Expression(6.0 * (theta - square)) / h) * (right.q - left.q);
  state.v += Expression(3.0 * square - 4.0 * theta + 1.0) * left.v + Expression(3.0 * square - 2.0 * theta) * right.v;
  return state;
}

}  // namespace

ShootingElement::ShootingElement(Shooting shooting, ExplicitIntegrator integrator, int substeps)
    : Element(shooting_name(shooting_family(shooting), integrator.name, substeps),
              fmt::format("direct {} shooting in (q, v) with {} step{} of {} per interval",
                          shooting == Shooting::single ? "single" : "multiple", substeps, substeps == 1 ? "" : "s",
                          integrator.name),
              NodeState::velocity),
      integrator_(std::move(integrator)),
      substeps_(substeps) {
  require_substeps(substeps);
}

IntervalTrace ShootingElement::trace(const TracedProblem& problem, const Tableau& tableau,
                                     const IntervalUnknowns& unknowns) const {
  const ControlledFlow flow(problem, tableau, unknowns);
  const double width = 1.0 / substeps_;
  const Expression h = Expression(width) * unknowns.h;
  std::vector<Flow> nodes{{unknowns.left_q, unknowns.left_second, Expression(0.0)}};
  for (int step = 0; step < substeps_; ++step) {
    nodes.push_back(advance(flow, integrator_, nodes.back(), h, step * width, width));
  }

  IntervalTrace trace;
  const Eigen::Index n = problem.configuration_size();
  const Flow& end = nodes.back();
  trace.stage_equations.resize(2 * n);
  trace.stage_equations << (unknowns.right_q - end.q) / unknowns.h, (unknowns.right_second - end.v) / unknowns.h;
  for (Eigen::Index i = 0; i < tableau.stages(); ++i) {
    const double tau = tableau.c[i];
    const int step = std::min(static_cast<int>(std::floor(tau * substeps_)), substeps_ - 1);
    const auto first = static_cast<std::size_t>(step);
    const State stage = on_cubic(nodes[first], nodes[first + 1], h, tau * substeps_ - step);
    trace.stages.push_back(
        {stage.q, stage.v, unknowns.controls[static_cast<std::size_t>(i)], unknowns.t + Expression(tau) * unknowns.h});
  }
  trace.cost = end.cost;
  trace.left_momentum = problem.at(State{unknowns.left_q, unknowns.left_second, unknowns.t}).momentum;
  trace.right_momentum = problem.at(State{unknowns.right_q, unknowns.right_second, unknowns.t + unknowns.h}).momentum;
  return trace;
}

void require_substeps(int substeps) {
  constexpr int most = ShootingElement::most_substeps;
  if (substeps >= 1 && substeps <= most) return;
  throw Error("shooting supports 1 to {} substeps per interval, got {}", most, substeps);
}

std::string shooting_name(std::string_view family, std::string_view integrator, int substeps) {
  return fmt::format("{}_{}_{}", family, integrator, substeps);
}

std::unique_ptr<Element> make_shooting_element(Shooting shooting, std::string_view integration) {
  const std::size_t bar = integration.rfind('_');
  const auto substeps = bar == std::string_view::npos ? std::nullopt : parsed<int>(integration.substr(bar + 1));
  if (!substeps) {
    const std::string name = fmt::format("{}_{}", shooting_family(shooting), integration);
    throw Error(R"("{}" does not name a number of substeps, as "{}_1" does)", name, name);
  }
  return std::make_unique<ShootingElement>(shooting, explicit_integrator(integration.substr(0, bar)), *substeps);
}

}  // namespace dmocbench
