#include "methods/transcription/derivatives/finite_differences.hpp"

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

class FiniteDifferences final : public DerivativeBackEnd {
 public:
  FiniteDifferences(const LocalFunctions& functions, const DerivativePlaces& places, DifferenceKind kind)
      : kind_(kind),
        intervals_(places.gradient.intervals),
        first_(functions.inputs.unknown(0)),
        unknowns_(functions.inputs.unknowns),
        cost_(functions.cost, intervals_, first_order_points),
        rows_(functions.rows.schedule, intervals_, first_order_points),
        // Forward: the point, every unknown moved, and two of them. Central: the point and the four corners around it.
        lagrangian_(functions.lagrangian, intervals_, std::max(unknowns_ + 2, 1 + mixed_points)),
        gradient_entries_(unknowns_),
        jacobian_entries_(unknowns_),
        hessian_rows_(functions.hessian.rows),
        hessian_columns_(functions.hessian.columns),
        gradient_(places.gradient),
        jacobian_(places.jacobian),
        hessian_(places.hessian),
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
  }

  void gradient(Inputs inputs, VectorOut result) override {
    first_order(cost_, gradient_entries_, inputs, gradient_, result);
  }
  void jacobian(Inputs inputs, VectorOut values) override {
    first_order(rows_, jacobian_entries_, inputs, jacobian_, values);
  }

  void hessian(Inputs inputs, VectorOut values) override {
    bind(inputs, difference_step(kind_, 2));
    if (kind_ == DifferenceKind::central) {
      central_curvatures(hessian_.open(values));
    } else {
      forward_curvatures(hessian_.open(values));
    }
    hessian_.close(values);
  }

 private:
  /// Formulas to be differentiated: a tape, and memory for its values at the point and at moved points.
  struct Formulas {
    Formulas(const Schedule& schedule, std::size_t interval_count, std::size_t points)
        : tape(schedule),
          workspace(tape),
          values(points * tape.output_count() * interval_count),
          series(points * tape.output_count()) {
      for (std::size_t c = 0; c < series.size(); ++c) series[c] = values.data() + c * interval_count;
    }
    [[nodiscard]] const double* value(std::size_t point, std::size_t output) const {
      return series[point * tape.output_count() + output];
    }

    Tape tape;
    Tape::Workspace workspace;
    std::vector<double> values;   // point by point, output by output
    std::vector<double*> series;  // where they begin
  };
  /// A derivative of first order: ∂output/∂unknown is entry `entry`.
  struct Quotient {
    std::size_t output;
    std::size_t entry;
  };

  void bind(Inputs inputs, double relative_step) {
    std::copy(inputs.begin(), inputs.end(), original_.begin());
    std::copy(inputs.begin(), inputs.end(), inputs_.begin());
    for (std::size_t a = 0; a < unknowns_; ++a) {
      const Tape::Input& x = inputs[first_ + a];
      for (std::size_t k = 0; k < intervals_; ++k) {
        steps_[a * intervals_ + k] = representable_step(x.data[x.same_for_all ? 0 : k], relative_step);
      }
    }
  }

  void move(std::size_t slot, std::size_t unknown, double factor) {
    double* moved = moved_.data() + slot * intervals_;
    const Tape::Input& x = original_[first_ + unknown];
    const double* step = steps_of(unknown);
    for (std::size_t k = 0; k < intervals_; ++k) moved[k] = x.data[x.same_for_all ? 0 : k] + factor * step[k];
    inputs_[first_ + unknown] = {moved, false};
  }

  void evaluate(Formulas& formulas, std::size_t point) {
    const std::size_t outputs = formulas.tape.output_count();
    formulas.tape.evaluate(intervals_, inputs_, std::span(formulas.series).subspan(point * outputs, outputs),
                           formulas.workspace);
  }
  void restore(std::size_t unknown) { inputs_[first_ + unknown] = original_[first_ + unknown]; }
  [[nodiscard]] const double* steps_of(std::size_t unknown) const { return steps_.data() + unknown * intervals_; }

  void first_order(Formulas& formulas, const std::vector<std::vector<Quotient>>& entries, Inputs inputs,
                   SeriesAssembly& assembly, VectorOut& result) {
    bind(inputs, difference_step(kind_, 1));
    const auto columns = assembly.open(result);
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
        double* column = columns[entry.entry];
        for (std::size_t k = 0; k < intervals_; ++k) column[k] = factor * (high[k] - low[k]) / step[k];
      }
    }
    assembly.close(result);
  }

  void central_curvatures(std::span<double* const> results) {
    evaluate(lagrangian_, at_point);
    const double* middle = lagrangian_.value(at_point, 0);
    const auto corner = [&](std::size_t index) { return lagrangian_.value(1 + index, 0); };
    for (std::size_t e = 0; e < results.size(); ++e) {
      const std::size_t a = hessian_rows_[e];
      const std::size_t b = hessian_columns_[e];
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

  void forward_curvatures(std::span<double* const> results) {
    evaluate(lagrangian_, at_point);
    for (std::size_t a = 0; a < unknowns_; ++a) {
      move(0, a, 1.0);
      evaluate(lagrangian_, 1 + a);
      restore(a);
    }
    const std::size_t both = unknowns_ + 1;
    const double* middle = lagrangian_.value(at_point, 0);
    for (std::size_t e = 0; e < results.size(); ++e) {
      const std::size_t a = hessian_rows_[e];
      const std::size_t b = hessian_columns_[e];
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

  DifferenceKind kind_;
  std::size_t intervals_;
  std::size_t first_;  // of the inputs that are unknowns
  std::size_t unknowns_;
  Formulas cost_;
  Formulas rows_;
  Formulas lagrangian_;
  std::vector<std::vector<Quotient>> gradient_entries_;  // per local unknown
  std::vector<std::vector<Quotient>> jacobian_entries_;
  std::vector<std::size_t> hessian_rows_;  // per entry
  std::vector<std::size_t> hessian_columns_;
  SeriesAssembly gradient_;
  SeriesAssembly jacobian_;
  SeriesAssembly hessian_;
  std::vector<Tape::Input> original_;
  std::vector<Tape::Input> inputs_;  // with moved unknowns
  std::vector<double> steps_;        // unknown by unknown
  std::vector<double> moved_;        // two series: a second difference moves two unknowns
};

}  // namespace

double difference_step(DifferenceKind kind, int derivative) {
  const double epsilon = std::numeric_limits<double>::epsilon();
  const int central = kind == DifferenceKind::central ? 1 : 0;
  return std::pow(epsilon, 1.0 / (derivative + 1 + central));
}

std::unique_ptr<DerivativeBackEnd> make_finite_differences(const LocalFunctions& functions,
                                                           const DerivativePlaces& places, DifferenceKind kind) {
  return std::make_unique<FiniteDifferences>(functions, places, kind);
}

}  // namespace dmocbench
