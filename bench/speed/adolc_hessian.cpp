#include "bench/speed/adolc_hessian.hpp"

#include <optional>

#include <adolc/adolc.h>

#include "methods/error.hpp"
#include "methods/expression/replay.hpp"

namespace dmocbench::speed {

namespace {

/// Records a schedule with the fewest operations that ADOL-C can do with: constants stay numbers, and no value is
/// copied. (`replay<adouble>` would record both.)
class Recorder {
 public:
  Recorder(const Schedule& schedule, const adouble* inputs) : schedule_(schedule), inputs_(inputs) {
    computed_.reserve(schedule.steps().size());  // places_ points into it
    for (const Schedule::Step& step : schedule.steps()) places_.push_back(record(step));
  }

  [[nodiscard]] const adouble& output() const { return *places_[schedule_.outputs().front()]; }

 private:
  [[nodiscard]] std::optional<double> constant(std::uint32_t position) const {
    const Schedule::Step& step = schedule_.steps()[position];
    return step.operation == Operation::constant ? std::optional(step.value) : std::nullopt;
  }

  template <class Value>
  const adouble* keep(const Value& value) {
    return &computed_.emplace_back(value);
  }

  const adouble* record(const Schedule::Step& step) {
    if (step.operation == Operation::constant) return nullptr;
    if (step.operation == Operation::input) return &inputs_[step.input_index];
    if (operand_count(step.operation) == 1) return record_unary(step.operation, *places_[step.left]);
    const auto left = constant(step.left);
    const auto right = constant(step.right);
    const adouble* x = places_[step.left];
    const adouble* y = places_[step.right];
    switch (step.operation) {
      case Operation::add:
        return left ? keep(*left + *y) : right ? keep(*x + *right) : keep(*x + *y);
      case Operation::subtract:
        return left ? keep(*left - *y) : right ? keep(*x - *right) : keep(*x - *y);
      case Operation::multiply:
        return left ? keep(*left * *y) : right ? keep(*x * *right) : keep(*x * *y);
      case Operation::divide:
        return left ? keep(*left / *y) : right ? keep(*x / *right) : keep(*x / *y);
      default:
        throw Error("no problem of this benchmark has the operation " + std::string(name_of(step.operation)));
    }
  }

  const adouble* record_unary(Operation operation, const adouble& x) {
    switch (operation) {
      case Operation::negate:
        return keep(-x);
      case Operation::reciprocal:
        return keep(1.0 / x);
      case Operation::square_root:
        return keep(sqrt(x));
      case Operation::sine:
        return keep(sin(x));
      case Operation::cosine:
        return keep(cos(x));
      default:
        throw Error("no problem of this benchmark has the operation " + std::string(name_of(operation)));
    }
  }

  const Schedule& schedule_;
  const adouble* inputs_;
  std::vector<adouble> computed_;
  std::vector<const adouble*> places_;  // null for constants
};

}  // namespace

AdolcHessian::AdolcHessian(short tag, const Schedule& lagrangian, const LocalInputs& inputs, std::size_t intervals)
    : tag_(tag),
      intervals_(intervals),
      input_count_(inputs.count()),
      directions_(inputs.unknowns),
      seed_(intervals * input_count_ * directions_),
      result_(seed_.size()) {
  for (std::size_t row = 0; row < intervals * input_count_; ++row) {
    seed_rows_.push_back(seed_.data() + row * directions_);
    result_rows_.push_back(result_.data() + row * directions_);
    const std::size_t input = row % input_count_;
    if (input < directions_) seed_rows_.back()[input] = 1.0;
  }
  trace_on(tag);
  {
    std::vector<adouble> independents(intervals * input_count_);
    for (adouble& independent : independents) independent <<= 1.0;
    adouble sum = 0.0;
    for (std::size_t k = 0; k < intervals; ++k) {
      sum += Recorder(lagrangian, independents.data() + k * input_count_).output();
    }
    double value = 0.0;
    sum >>= value;
  }
  trace_off();
}

void AdolcHessian::evaluate(const Subject& subject, std::size_t first) {
  // The driver takes its point as double* and only reads it.
  double* point =
      const_cast<double*>(subject.inputs_of(first).data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  const int status = hess_mat(tag_, static_cast<int>(intervals_ * input_count_), static_cast<int>(directions_), point,
                              seed_rows_.data(), result_rows_.data());
  if (status < 0) throw Error("ADOL-C's hess_mat failed");
}

}  // namespace dmocbench::speed
