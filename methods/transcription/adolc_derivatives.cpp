#include "methods/transcription/adolc_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <set>
#include <type_traits>

#include <adolc/adolc.h>

#include "methods/error.hpp"
#include "methods/expression/replay.hpp"

namespace dmocbench {

namespace {

/// A number of a recording. It is a constant until it is combined with an independent variable, so that ADOL-C records
/// no operation on constants. Copies share the variable, so that copying records nothing.
class RecordedNumber {
 public:
  explicit RecordedNumber(double value) : value_(value) {}
  explicit RecordedNumber(std::shared_ptr<const adouble> variable) : variable_(std::move(variable)) {}

  /// The result of a function of ADOL-C. (It is never applied to constants, which are folded while formulas are
  /// traced.)
  template <class Function>
  static RecordedNumber of(const Function& function, const RecordedNumber& x) {
    return kept(x.variable_ ? function(*x.variable_) : function(adouble(x.value_)));
  }
  /// The result of an operation that is defined on doubles and on ADOL-C's variables.
  template <class Function>
  static RecordedNumber of(const Function& function, const RecordedNumber& x, const RecordedNumber& y) {
    if (x.variable_ && y.variable_) return kept(function(*x.variable_, *y.variable_));
    if (x.variable_) return kept(function(*x.variable_, y.value_));
    if (y.variable_) return kept(function(x.value_, *y.variable_));
    return kept(function(x.value_, y.value_));
  }
  [[nodiscard]] adouble variable() const { return variable_ ? *variable_ : adouble(value_); }

 private:
  template <class Result>
  static RecordedNumber kept(const Result& result) {
    if constexpr (std::is_same_v<Result, double>) {
      return RecordedNumber(result);
    } else {
      return RecordedNumber(std::make_shared<const adouble>(result));
    }
  }

  double value_ = 0.0;
  std::shared_ptr<const adouble> variable_;  // null for a constant
};

using Number = RecordedNumber;

Number operator+(const Number& x, const Number& y) {
  return Number::of([](const auto& a, const auto& b) { return a + b; }, x, y);
}
Number operator-(const Number& x, const Number& y) {
  return Number::of([](const auto& a, const auto& b) { return a - b; }, x, y);
}
Number operator*(const Number& x, const Number& y) {
  return Number::of([](const auto& a, const auto& b) { return a * b; }, x, y);
}
Number operator/(const Number& x, const Number& y) {
  return Number::of([](const auto& a, const auto& b) { return a / b; }, x, y);
}
Number operator/(double x, const Number& y) { return Number(x) / y; }
Number operator-(const Number& x) {
  return Number::of([](const auto& a) { return -a; }, x);
}
Number sqrt(const Number& x) {
  return Number::of([](const auto& a) { return sqrt(a); }, x);
}
Number exp(const Number& x) {
  return Number::of([](const auto& a) { return exp(a); }, x);
}
Number log(const Number& x) {
  return Number::of([](const auto& a) { return log(a); }, x);
}
Number sin(const Number& x) {
  return Number::of([](const auto& a) { return sin(a); }, x);
}
Number cos(const Number& x) {
  return Number::of([](const auto& a) { return cos(a); }, x);
}
Number tan(const Number& x) {
  return Number::of([](const auto& a) { return tan(a); }, x);
}
Number asin(const Number& x) {
  return Number::of([](const auto& a) { return asin(a); }, x);
}
Number acos(const Number& x) {
  return Number::of([](const auto& a) { return acos(a); }, x);
}
Number atan(const Number& x) {
  return Number::of([](const auto& a) { return atan(a); }, x);
}
Number sinh(const Number& x) {
  return Number::of([](const auto& a) { return sinh(a); }, x);
}
Number cosh(const Number& x) {
  return Number::of([](const auto& a) { return cosh(a); }, x);
}
Number tanh(const Number& x) {
  return Number::of([](const auto& a) { return tanh(a); }, x);
}
Number pow(const Number& x, double exponent) {
  return Number::of([exponent](const auto& a) { return pow(a, exponent); }, x);
}
Number atan2(const Number& x, const Number& y) {
  // ADOL-C's atan2 takes no constants.
  return Number(std::make_shared<const adouble>(atan2(x.variable(), y.variable())));
}

/// The numbers under which ADOL-C keeps our recordings, far from those that a user would choose.
class Tags {
 public:
  static short take() {
    const std::lock_guard lock(mutex());
    short tag = first;
    while (used().contains(tag)) ++tag;
    used().insert(tag);
    return tag;
  }
  static void give_back(short tag) {
    const std::lock_guard lock(mutex());
    used().erase(tag);
  }

 private:
  static constexpr short first = 16384;
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  static std::set<short>& used() {
    static std::set<short> instance;
    return instance;
  }
};

void require_success(int status, const char* driver) {
  if (status < 0) throw Error(std::string("ADOL-C's ") + driver + " failed on the formulas of an interval");
}

}  // namespace

AdolcDerivatives::Recording::Recording(const Schedule& schedule)
    : tag_(Tags::take()), output_count_(schedule.outputs().size()), point_(schedule.input_count()) {
  trace_on(tag_);
  {
    std::vector<Number> inputs;
    for (std::size_t i = 0; i < point_.size(); ++i) {
      const auto independent = std::make_shared<adouble>();
      *independent <<= 1.0;
      inputs.emplace_back(independent);
    }
    for (const Number& output : replay<Number>(schedule, std::span<const Number>(inputs))) {
      adouble dependent = output.variable();
      double value = 0.0;
      dependent >>= value;
    }
  }
  trace_off();
}

AdolcDerivatives::Recording::~Recording() {
  removeTape(tag_, ADOLC_REMOVE_COMPLETELY);
  Tags::give_back(tag_);
}

double* AdolcDerivatives::Recording::point(Inputs inputs, std::size_t interval) {
  for (std::size_t i = 0; i < point_.size(); ++i) point_[i] = inputs[i].data[inputs[i].same_for_all ? 0 : interval];
  return point_.data();
}

AdolcDerivatives::Dense::Dense(std::size_t rows, std::size_t columns) : entries_(rows * columns), rows_(rows) {
  for (std::size_t i = 0; i < rows; ++i) rows_[i] = entries_.data() + i * columns;
}

AdolcDerivatives::AdolcDerivatives(const LocalFunctions& functions, const DerivativePlaces& places)
    : cost_(functions.cost),
      rows_(functions.rows.schedule),
      lagrangian_(functions.lagrangian),
      gradient_unknowns_(functions.gradient.places),
      gradient_(places.gradient_places, places.gradient_size, places.intervals, places.mode),
      jacobian_(places.jacobian_places, places.jacobian_size, places.intervals, places.mode),
      hessian_(places.hessian_places, places.hessian_size, places.intervals, places.mode),
      cost_gradient_(cost_.input_count()),
      rows_jacobian_(rows_.output_count(), rows_.input_count()),
      directions_(functions.inputs.unknowns),
      seeds_(lagrangian_.input_count(), directions_),
      seeded_hessian_(lagrangian_.input_count(), directions_) {
  std::vector<std::size_t> output_of_row(functions.inputs.rows);
  for (std::size_t o = 0; o < functions.rows.places.size(); ++o) output_of_row[functions.rows.places[o]] = o;
  for (std::size_t e = 0; e < functions.jacobian.rows.size(); ++e) {
    jacobian_positions_.push_back({output_of_row[functions.jacobian.rows[e]], functions.jacobian.columns[e]});
  }
  for (std::size_t e = 0; e < functions.hessian.rows.size(); ++e) {
    hessian_positions_.push_back({functions.hessian.rows[e], functions.hessian.columns[e]});
  }
  for (std::size_t a = 0; a < directions_; ++a) seeds_(a, a) = 1.0;
}

void AdolcDerivatives::gradient(Inputs inputs, VectorOut result) {
  const auto columns = gradient_.open(result);
  const int count = static_cast<int>(cost_.input_count());
  for (std::size_t k = 0; k < gradient_.intervals(); ++k) {
    require_success(::gradient(cost_.tag(), count, cost_.point(inputs, k), cost_gradient_.data()), "gradient");
    for (std::size_t e = 0; e < columns.size(); ++e) columns[e][k] = cost_gradient_[gradient_unknowns_[e]];
  }
  gradient_.close(result);
}

void AdolcDerivatives::jacobian(Inputs inputs, VectorOut values) {
  const auto columns = jacobian_.open(values);
  const int outputs = static_cast<int>(rows_.output_count());
  const int count = static_cast<int>(rows_.input_count());
  for (std::size_t k = 0; k < jacobian_.intervals(); ++k) {
    require_success(::jacobian(rows_.tag(), outputs, count, rows_.point(inputs, k), rows_jacobian_.rows()), "jacobian");
    for (std::size_t e = 0; e < columns.size(); ++e) {
      columns[e][k] = rows_jacobian_(jacobian_positions_[e].row, jacobian_positions_[e].column);
    }
  }
  jacobian_.close(values);
}

void AdolcDerivatives::hessian(Inputs inputs, VectorOut values) {
  const auto columns = hessian_.open(values);
  const int count = static_cast<int>(lagrangian_.input_count());
  for (std::size_t k = 0; k < hessian_.intervals(); ++k) {
    require_success(hess_mat(lagrangian_.tag(), count, static_cast<int>(directions_), lagrangian_.point(inputs, k),
                             seeds_.rows(), seeded_hessian_.rows()),
                    "hess_mat");
    for (std::size_t e = 0; e < columns.size(); ++e) {
      columns[e][k] = seeded_hessian_(hessian_positions_[e].row, hessian_positions_[e].column);
    }
  }
  hessian_.close(values);
}

}  // namespace dmocbench
