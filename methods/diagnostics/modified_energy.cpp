#include "methods/diagnostics/modified_energy.hpp"

#include <utility>

#include "methods/error.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

namespace {

/// A⁻¹ b by elimination without pivoting; nothing is known of the size of traced numbers.
ExpressionVector eliminate(ExpressionMatrix a, ExpressionVector b) {
  const Eigen::Index n = b.size();
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const Expression factor = a(i, k) / a(k, k);
      for (Eigen::Index j = k; j < n; ++j) a(i, j) -= factor * a(k, j);
      b[i] -= factor * b[k];
    }
  }
  for (Eigen::Index k = n - 1; k >= 0; --k) {
    for (Eigen::Index j = k + 1; j < n; ++j) b[k] -= a(k, j) * b[j];
    b[k] /= a(k, k);
  }
  return b;
}

/// A tangent vector of phase space in the coordinates (q, p).
struct Direction {
  ExpressionVector q;
  ExpressionVector p;
};

/// Derivatives of functions of (q, p) that are written in (q, v): p = L_v(q, v) gives dv = L_vv⁻¹ (dp - L_vq dq).
class PhaseSpace {
 public:
  PhaseSpace(ExpressionVector q, ExpressionVector v, const TracedProblem::Values& values)
      : q_(std::move(q)), v_(std::move(v)), mass_(values.mass), mixed_(values.momentum_by_configuration) {}

  /// D_c f for a direction c that is constant in (q, p).
  [[nodiscard]] Expression derivative(const Expression& f, const Direction& c) const {
    return dot(gradient(f, q_), c.q) + dot(gradient(f, v_), eliminate(mass_, c.p - mixed_ * c.q));
  }
  /// J∇f = (∂f/∂p, -∂f/∂q).
  [[nodiscard]] Direction flow_of(const Expression& f) const {
    const ExpressionVector by_momentum = eliminate(mass_, gradient(f, v_));
    const ExpressionMatrix transposed = mixed_.transpose();
    return {by_momentum, transposed * by_momentum - gradient(f, q_)};
  }

 private:
  static Expression dot(const ExpressionVector& x, const ExpressionVector& y) {
    Expression sum;
    for (Eigen::Index i = 0; i < x.size(); ++i) sum += x[i] * y[i];
    return sum;
  }
  ExpressionVector q_;
  ExpressionVector v_;
  ExpressionMatrix mass_;
  ExpressionMatrix mixed_;
};

/// The inputs of all formulas: the point, then two directions that are constant until they are replaced.
struct Inputs {
  Inputs(Eigen::Index n, Eigen::Index m)
      : q(counter.take(n)),
        v(counter.take(n)),
        u(counter.take(m)),
        t(counter.take()),
        c{counter.take(n), counter.take(n)},
        d{counter.take(n), counter.take(n)} {}

  /// The formula with c and d replaced.
  [[nodiscard]] Expression with(const Expression& f, const Direction& for_c, const Direction& for_d) const {
    std::vector<Expression> values(entries_of(q).begin(), entries_of(q).end());
    append(values, v);
    append(values, u);
    values.push_back(t);
    for (const ExpressionVector& entries : {for_c.q, for_c.p, for_d.q, for_d.p}) append(values, entries);
    return replay<Expression>(Schedule(ExpressionVector::Constant(1, f)), std::span<const Expression>(values)).front();
  }
  [[nodiscard]] Expression with(const Expression& f, const Direction& for_c) const { return with(f, for_c, d); }

  InputCounter counter;
  ExpressionVector q, v, u;
  Expression t;
  Direction c, d;
};

std::vector<long double> joined(std::initializer_list<LongVector> parts) {
  std::vector<long double> values;
  for (const LongVector& part : parts) values.insert(values.end(), part.begin(), part.end());
  return values;
}

StepSeries series_of(const Schedule& schedule, const std::vector<long double>& inputs) {
  const std::vector<long double> values = replay<long double>(schedule, std::span<const long double>(inputs));
  return {values[0], values[1], values[2]};
}

}  // namespace

StepSeries partial_sums(const StepSeries& series, long double h) {
  const long double second = series[0] + h * h * series[1];
  return {series[0], second, second + h * h * h * h * series[2]};
}

ModifiedEnergy::ModifiedEnergy(const Problem& problem) {
  const TracedProblem traced(problem);
  traced.require_no_constraints("the modified energy");
  const Eigen::Index n = traced.configuration_size();
  const Inputs in(n, traced.control_size());
  const TracedProblem::Values values = traced.at({in.q, in.v, in.u, in.t});
  const PhaseSpace space(in.q, in.v, values);
  Expression energy = -problem.lagrangian({in.q, in.v, in.t});
  if (!gradient(energy, ExpressionVector::Constant(1, in.t))[0].is_zero()) {
    throw Error(problem.name() + " has a Lagrangian that depends on time, so its energy is not conserved");
  }
  for (Eigen::Index i = 0; i < n; ++i) energy += values.momentum[i] * in.v[i];

  const Direction unforced{in.v, values.configuration_force};
  const Direction forced{in.v, values.generalised_force};
  const auto d = [&](const Expression& f) { return space.derivative(f, in.c); };
  const Expression first = d(energy);
  const Expression second = d(first);
  const Expression third = d(second);
  const Expression fourth = d(third);
  const Expression h_2 = -1.0 / 24.0 * in.with(second, unforced);
  const Expression first_of_h_2 = d(h_2);
  const Expression second_of_h_2 = d(first_of_h_2);
  const Expression h_4 = -1.0 / 24.0 * in.with(second_of_h_2, unforced) -
                         1.0 / 30.0 * in.with(space.derivative(first, in.d), unforced, space.flow_of(h_2)) -
                         1.0 / 1920.0 * in.with(fourth, unforced);
  energy_ = Schedule(ExpressionVector{{energy, h_2, h_4}});

  Expression power;
  for (Eigen::Index i = 0; i < n; ++i) power += values.control_force[i] * in.v[i];
  const Expression w_2 = in.with(1.0 / 24.0 * third + first_of_h_2, forced);
  const Expression w_4 = in.with(1.0 / 1920.0 * d(fourth) + 1.0 / 24.0 * d(second_of_h_2) + d(h_4), forced);
  power_ = Schedule(ExpressionVector{{power, w_2, w_4}});

  const ExpressionVector p = input_vector(static_cast<std::size_t>(2 * n), n);
  transform_ = TracedNewton<long double>(values.momentum - p, static_cast<std::size_t>(n), n);
}

StepSeries ModifiedEnergy::energy(const LongVector& q, const LongVector& v) const {
  return series_of(energy_, joined({q, v}));
}

StepSeries ModifiedEnergy::power(const LongVector& q, const LongVector& v, const LongVector& u, long double t) const {
  return series_of(power_, joined({q, v, u, LongVector::Constant(1, t)}));
}

LongVector ModifiedEnergy::velocity(const LongVector& q, const LongVector& p, const LongVector& start) const {
  std::vector<long double> inputs = joined({q, start, p});
  transform_.solve(inputs);
  return Eigen::Map<const LongVector>(inputs.data() + q.size(), q.size());
}

}  // namespace dmocbench
