#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <adolc/adolc.h>
#include <benchmark/benchmark.h>

#include "bench/speed/interval_benchmark.hpp"
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
    const adouble* x = places_[step.left];
    switch (step.operation) {
      case Operation::negate:
        return keep(-*x);
      case Operation::reciprocal:
        return keep(1.0 / *x);
      case Operation::square_root:
        return keep(sqrt(*x));
      case Operation::sine:
        return keep(sin(*x));
      case Operation::cosine:
        return keep(cos(*x));
      case Operation::add:
        return record_binary(step, std::plus<>());
      case Operation::subtract:
        return record_binary(step, std::minus<>());
      case Operation::multiply:
        return record_binary(step, std::multiplies<>());
      case Operation::divide:
        return record_binary(step, std::divides<>());
      default:
        throw Error("no problem of this benchmark has the operation " + std::string(name_of(step.operation)));
    }
  }

  template <class Operator>
  const adouble* record_binary(const Schedule::Step& step, Operator combine) {
    const auto left = constant(step.left);
    const auto right = constant(step.right);
    const adouble* x = places_[step.left];
    const adouble* y = places_[step.right];
    return left ? keep(combine(*left, *y)) : right ? keep(combine(*x, *right)) : keep(combine(*x, *y));
  }

  const Schedule& schedule_;
  const adouble* inputs_;
  std::vector<adouble> computed_;
  std::vector<const adouble*> places_;  // null for constants
};

/// The Hessian of the Lagrangian of one or more intervals by ADOL-C's driver hess_mat.
///
/// ADOL-C records the formula of ℓ once and differentiates it itself. Multipliers, factor and step are further
/// independent variables, in whose directions nothing is differentiated. (Changing them with set_param_vec is no
/// faster, and recording anew for every interval is slower.) The second derivatives are taken in the directions of the
/// n local unknowns, all n in one pass; the drivers hessian and hessian2 are no faster. With several intervals on one
/// tape the n directions serve all of them at once, since no interval's ℓ depends on another's inputs: the compression
/// that a graph colouring would find.
class AdolcHessian {
 public:
  /// `tag` is ADOL-C's number of the tape. Record small tapes before large ones: a small one that is recorded after a
  /// large one runs several times slower, as if it carried the large one's variables.
  AdolcHessian(short tag, const Schedule& lagrangian, const LocalInputs& inputs, std::size_t intervals)
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

  /// Intervals `first` .. `first` + `intervals` - 1.
  void evaluate(const BenchmarkedFormulas& point, std::size_t first) {
    // The driver takes its point as double* and only reads it.
    double* independents =
        const_cast<double*>(point.inputs_of(first).data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    const int status = hess_mat(tag_, static_cast<int>(intervals_ * input_count_), static_cast<int>(directions_),
                                independents, seed_rows_.data(), result_rows_.data());
    if (status < 0) throw Error("ADOL-C's hess_mat failed");
  }
  /// ∂²ℓ/∂z_i∂z_j of interval `first` + `offset` of the last evaluation.
  [[nodiscard]] double entry(std::size_t offset, std::size_t i, std::size_t j) const {
    return result_rows_[offset * input_count_ + i][j];
  }

 private:
  short tag_;
  std::size_t intervals_;
  std::size_t input_count_;  // of one interval
  std::size_t directions_;
  std::vector<double> seed_;
  std::vector<double> result_;
  std::vector<double*> seed_rows_;
  std::vector<double*> result_rows_;
};

void register_hessian(const std::string& quantity, short tag, const BenchmarkedFormulas& point, std::size_t intervals) {
  const Schedule lagrangian = lagrangian_of(point.functions());
  const auto adolc = std::make_shared<AdolcHessian>(tag, lagrangian, point.functions().inputs, intervals);
  const LocalMatrix& hessian = point.functions().hessian;
  require_agreement(point, hessian.schedule, "ADOL-C", [&](std::size_t interval) {
    if (interval % intervals == 0) adolc->evaluate(point, interval);
    std::vector<double> entries;
    for (std::size_t e = 0; e < hessian.rows.size(); ++e) {
      entries.push_back(adolc->entry(interval % intervals, hessian.rows[e], hessian.columns[e]));
    }
    return entries;
  });
  const auto evaluate = [&point, adolc, intervals] {
    for (std::size_t k = 0; k < BenchmarkedFormulas::intervals; k += intervals) {
      adolc->evaluate(point, k);
      benchmark::ClobberMemory();
    }
  };
  register_benchmark({.way = "adolc", .quantity = quantity, .formulas = point.formulas()},
                     Evaluation{evaluate, {.operations = lagrangian.operation_count()}});
}

}  // namespace

void register_adolc_benchmarks(const FormulasOfPaper& paper) {
  short tag = 0;
  for (const auto& point : paper) register_hessian("hessian", tag++, *point, 1);
  for (const auto& point : paper) register_hessian("hessian_block", tag++, *point, 64);
}

}  // namespace dmocbench::speed
