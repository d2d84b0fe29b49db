#include "methods/mechanics/problem.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <typeinfo>
#include <utility>

#include "methods/error.hpp"
#include "methods/mechanics/class_name.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/point_function.hpp"

namespace dmocbench {

namespace {

/// ∫ |C| dt + |Φ| along the guess; empty if its parts have the wrong size, which is reported elsewhere.
std::optional<double> magnitude_of_guessed_cost(const Problem& problem) {
  constexpr int points = 64;
  const double horizon = problem.horizon();
  const Eigen::Index n = problem.configuration_size();
  const Eigen::Index m = problem.control_size();
  const Eigen::Index l = problem.first_order_size();
  const auto fits = [n, l](const BoundaryState& end) {
    return end.q.size() == n && end.v.size() == n && end.y.size() == l;
  };
  const bool has_ends = fits(problem.initial_state()) && fits(problem.final_state());  // the default guess reads them
  if (n == 0 || !has_ends || !(horizon > 0.0)) return std::nullopt;
  PointFunction cost(problem, [&](const ControlledState& x) {
    ExpressionVector both(2);
    both << call_formula(problem, "running_cost", [&] { return problem.running_cost(x); }),
        call_formula(problem, "final_cost", [&] { return problem.final_cost(x.state()); });
    return both;
  });
  Eigen::Vector2d values;
  double sum = 0.0;
  for (int i = 0; i <= points; ++i) {  // the last point is the end
    const double t = i < points ? horizon * (i + 0.5) / points : horizon;
    const MotionPoint point = problem.guess(t);
    if (point.q.size() != n || point.v.size() != n || point.u.size() != m || point.y.size() != l) return std::nullopt;
    cost.evaluate(point, t, values);
    sum += i < points ? std::abs(values[0]) * horizon / points : std::abs(values[1]);
  }
  return sum;
}

}  // namespace

std::string Problem::name() const {
  const std::string type = class_name(typeid(*this));
  std::string name;
  for (const char letter : type) {
    const bool is_capital = std::isupper(static_cast<unsigned char>(letter)) != 0;
    if (is_capital && !name.empty() && name.back() != '_') name += '_';
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return name;
}

std::unique_ptr<Problem> Problem::clone() const {
  const std::string type = class_name(typeid(*this));
  throw Error(
      "{} cannot be copied, because clone() is not overridden; give {} the line \"std::unique_ptr<Problem> "
      "clone() const override {{ return copy_of(*this); }}\"",
      name(), type);
}

double Problem::cost_scale() const {
  constexpr int left_alone = 5;  // powers of two
  const std::optional<double> cost = magnitude_of_guessed_cost(*this);
  if (!cost || !std::isnormal(*cost)) return 1.0;
  const int exponent = static_cast<int>(std::lround(-std::log2(*cost)));
  return std::abs(exponent) <= left_alone ? 1.0 : std::ldexp(1.0, exponent);
}

Eigen::Index Problem::configuration_size() const { return static_cast<Eigen::Index>(configuration_names().size()); }

Eigen::Index Problem::control_size() const { return static_cast<Eigen::Index>(control_names().size()); }

Eigen::Index Problem::first_order_size() const { return static_cast<Eigen::Index>(first_order_names().size()); }

ProblemBounds Problem::bounds() const {
  ProblemBounds bounds;
  bounds.first = EndBounds::fixed(initial_state());
  bounds.last = EndBounds::fixed(final_state());
  bounds.horizon = {horizon(), horizon()};
  return bounds;
}

MotionPoint Problem::guess(double t) const {
  const BoundaryState first = initial_state();
  const BoundaryState last = final_state();
  const double relative = t / horizon();
  return {.q = first.q + relative * (last.q - first.q),
          .v = (last.q - first.q) / horizon(),
          .u = Eigen::VectorXd::Zero(control_size()),
          .y = first.y + relative * (last.y - first.y)};
}

Picture pictured_quantities(const Problem& problem, const ControlledState& x) {
  const ProblemCard card = problem.card();
  if (card.picture) return card.picture(x);
  Picture quantities;
  const auto add = [&](const std::vector<std::string>& names, const std::vector<std::string>& units,
                       const ExpressionVector& values) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      quantities.push_back({names[i], i < units.size() ? units[i] : "", values[static_cast<Eigen::Index>(i)]});
    }
  };
  add(problem.configuration_names(), card.configuration_units, x.q);
  add(problem.first_order_names(), {}, x.y);
  add(problem.control_names(), card.control_units, x.u);
  return quantities;
}

}  // namespace dmocbench
