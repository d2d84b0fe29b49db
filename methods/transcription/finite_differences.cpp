#include "methods/transcription/finite_differences.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmocbench {

namespace {

// The points at which the values of a formula are stored.
constexpr std::size_t at_point = 0;
constexpr std::size_t ahead = 1;
constexpr std::size_t behind = 2;
constexpr std::size_t first_order_points = 3;
constexpr std::size_t mixed_points = 4;

/// The step that x + step really adds, which is rounded.
double representable_step(double x, double relative_step) {
  const double moved = x + relative_step * std::max(1.0, std::abs(x));
  return moved - x;
}

}  // namespace

double difference_step(DifferenceKind kind, int derivative) {
  const double epsilon = std::numeric_limits<double>::epsilon();
  const int central = kind == DifferenceKind::central ? 1 : 0;
  return std::pow(epsilon, 1.0 / (derivative + 1 + central));
}

FiniteDifferences::Formulas::Formulas(const Schedule& schedule, std::size_t interval_count, std::size_t points)
    : tape(schedule),
      workspace(tape),
      intervals(interval_count),
      values(points * tape.output_count() * intervals),
      series(points * tape.output_count()) {
  for (std::size_t c = 0; c < series.size(); ++c) series[c] = values.data() + c * intervals;
}

const double* FiniteDifferences::Formulas::value(std::size_t point, std::size_t output) const {
  return series[point * tape.output_count() + output];
}

FiniteDifferences::FiniteDifferences(const LocalFunctions& functions, const DerivativePlaces& places,
                                     DifferenceKind kind)
    : kind_(kind),
      intervals_(places.intervals),
      unknowns_(functions.inputs.unknowns),
      cost_(functions.cost, intervals_, first_order_points),
      rows_(functions.rows.schedule, intervals_, first_order_points),
      // Forward: the point, every unknown moved, and two of them. Central: the point and the four corners around it.
      lagrangian_(functions.lagrangian, intervals_, std::max(unknowns_ + 2, 1 + mixed_points)),
      gradient_entries_(unknowns_),
      jacobian_entries_(unknowns_),
      gradient_(places.gradient_places, places.gradient_size, intervals_, places.mode),
      jacobian_(places.jacobian_places, places.jacobian_size, intervals_, places.mode),
      hessian_(places.hessian_places, places.hessian_size, intervals_, places.mode),
      original_(functions.inputs.count()),
      inputs_(functions.inputs.count()),
      steps_(unknowns_ * intervals_),
      moved_(2 * intervals_) {
  for (std::size_t e = 0; e < functions.gradient.places.size(); ++e) {
    gradient_entries_[functions.gradient.places[e]].push_back({0, e});
  }
  std::vector<std::size_t> output_of_row(functions.inputs.rows);
  for (std::size_t o = 0; o < functions.rows.places.size(); ++o) output_of_row[functions.rows.places[o]] = o;
  for (std::size_t e = 0; e < functions.jacobian.rows.size(); ++e) {
    jacobian_entries_[functions.jacobian.columns[e]].push_back({output_of_row[functions.jacobian.rows[e]], e});
  }
  for (std::size_t e = 0; e < functions.hessian.rows.size(); ++e) {
    hessian_entries_.push_back({functions.hessian.rows[e], functions.hessian.columns[e]});
  }
}

void FiniteDifferences::bind(Inputs inputs, double relative_step) {
  std::copy(inputs.begin(), inputs.end(), original_.begin());
  std::copy(inputs.begin(), inputs.end(), inputs_.begin());
  for (std::size_t a = 0; a < unknowns_; ++a) {
    const Tape::Input& x = inputs[a];
    for (std::size_t k = 0; k < intervals_; ++k) {
      steps_[a * intervals_ + k] = representable_step(x.data[x.same_for_all ? 0 : k], relative_step);
    }
  }
}

void FiniteDifferences::move(std::size_t slot, std::size_t unknown, double factor) {
  double* moved = moved_.data() + slot * intervals_;
  const Tape::Input& x = original_[unknown];
  const double* step = steps_of(unknown);
  for (std::size_t k = 0; k < intervals_; ++k) moved[k] = x.data[x.same_for_all ? 0 : k] + factor * step[k];
  inputs_[unknown] = {moved, false};
}

void FiniteDifferences::evaluate(Formulas& formulas, std::size_t point) {
  const std::size_t outputs = formulas.tape.output_count();
  formulas.tape.evaluate(intervals_, inputs_, std::span(formulas.series).subspan(point * outputs, outputs),
                         formulas.workspace);
}

void FiniteDifferences::quotients(Formulas& formulas, const std::vector<std::vector<Quotient>>& entries,
                                  std::span<double* const> results) {
  const bool central = kind_ == DifferenceKind::central;
  const std::size_t lower = central ? behind : at_point;
  const double factor = central ? 0.5 : 1.0;
  if (!central) evaluate(formulas, at_point);
  for (std::size_t a = 0; a < unknowns_; ++a) {
    if (entries[a].empty()) continue;
    move(0, a, 1.0);
    evaluate(formulas, ahead);
    if (central) {
      move(0, a, -1.0);
      evaluate(formulas, behind);
    }
    restore(a);
    const double* step = steps_of(a);
    for (const Quotient& entry : entries[a]) {
      const double* high = formulas.value(ahead, entry.output);
      const double* low = formulas.value(lower, entry.output);
      double* result = results[entry.entry];
      for (std::size_t k = 0; k < intervals_; ++k) result[k] = factor * (high[k] - low[k]) / step[k];
    }
  }
}

void FiniteDifferences::central_curvatures(std::span<double* const> results) {
  evaluate(lagrangian_, at_point);
  const double* middle = lagrangian_.value(at_point, 0);
  const auto corner = [&](std::size_t index) { return lagrangian_.value(1 + index, 0); };
  for (std::size_t e = 0; e < hessian_entries_.size(); ++e) {
    const auto [a, b] = hessian_entries_[e];
    const double* s = steps_of(a);
    const double* t = steps_of(b);
    double* result = results[e];
    if (a == b) {
      for (std::size_t side = 0; side < 2; ++side) {
        move(0, a, side == 0 ? 1.0 : -1.0);
        evaluate(lagrangian_, 1 + side);
      }
      for (std::size_t k = 0; k < intervals_; ++k) {
        result[k] = ((corner(0)[k] - middle[k]) - (middle[k] - corner(1)[k])) / (s[k] * s[k]);
      }
    } else {
      for (std::size_t index = 0; index < mixed_points; ++index) {
        move(0, a, index < 2 ? 1.0 : -1.0);
        move(1, b, index % 2 == 0 ? 1.0 : -1.0);
        evaluate(lagrangian_, 1 + index);
      }
      for (std::size_t k = 0; k < intervals_; ++k) {
        result[k] = ((corner(0)[k] - corner(1)[k]) - (corner(2)[k] - corner(3)[k])) / (4.0 * s[k] * t[k]);
      }
    }
    restore(a);
    restore(b);
  }
}

void FiniteDifferences::forward_curvatures(std::span<double* const> results) {
  evaluate(lagrangian_, at_point);
  for (std::size_t a = 0; a < unknowns_; ++a) {
    move(0, a, 1.0);
    evaluate(lagrangian_, 1 + a);
    restore(a);
  }
  const std::size_t both = unknowns_ + 1;
  const double* middle = lagrangian_.value(at_point, 0);
  for (std::size_t e = 0; e < hessian_entries_.size(); ++e) {
    const auto [a, b] = hessian_entries_[e];
    move(0, a, a == b ? 2.0 : 1.0);
    if (a != b) move(1, b, 1.0);
    evaluate(lagrangian_, both);
    restore(a);
    restore(b);
    const double* s = steps_of(a);
    const double* t = steps_of(b);
    const double* corner = lagrangian_.value(both, 0);
    const double* along_a = lagrangian_.value(1 + a, 0);
    const double* along_b = lagrangian_.value(1 + b, 0);
    double* result = results[e];
    for (std::size_t k = 0; k < intervals_; ++k) {
      result[k] = ((corner[k] - along_a[k]) - (along_b[k] - middle[k])) / (s[k] * t[k]);
    }
  }
}

void FiniteDifferences::gradient(Inputs inputs, VectorOut result) {
  bind(inputs, difference_step(kind_, 1));
  quotients(cost_, gradient_entries_, gradient_.open(result));
  gradient_.close(result);
}

void FiniteDifferences::jacobian(Inputs inputs, VectorOut values) {
  bind(inputs, difference_step(kind_, 1));
  quotients(rows_, jacobian_entries_, jacobian_.open(values));
  jacobian_.close(values);
}

void FiniteDifferences::hessian(Inputs inputs, VectorOut values) {
  bind(inputs, difference_step(kind_, 2));
  if (kind_ == DifferenceKind::central) {
    central_curvatures(hessian_.open(values));
  } else {
    forward_curvatures(hessian_.open(values));
  }
  hessian_.close(values);
}

}  // namespace dmocbench
