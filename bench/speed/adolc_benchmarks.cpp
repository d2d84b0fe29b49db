#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <adolc/adolc.h>
#include <benchmark/benchmark.h>

#include "bench/speed/interval_benchmark.hpp"
#include "methods/error.hpp"
#include "methods/expression/replay.hpp"
#include "methods/transcription/derivatives/recorded_number.hpp"

namespace dmocbench::speed {

namespace {

/// The Hessian of the Lagrangian of one or more intervals by ADOL-C's driver hess_mat.
///
/// ADOL-C records the formula of ℓ once and differentiates it itself, in the directions of the n local unknowns, all n
/// in one pass. Multipliers, factor and step are further independent variables, without directions of
/// differentiation. With several intervals on one tape the n directions serve all of them at once, since no interval's
/// ℓ depends on another's inputs: the compression that a graph colouring would find. (Why this driver: README.md.)
class AdolcHessian {
 public:
  /// `tag` is ADOL-C's number of the tape. Record small tapes before large ones: a small one that is recorded after a
  /// large one runs several times slower, as if it carried the large one's variables.
  AdolcHessian(short tag, const Schedule& lagrangian, const LocalInputs& inputs, std::size_t intervals)
      : tag_(tag), input_count_(static_cast<Eigen::Index>(inputs.count())) {
    const auto count = static_cast<Eigen::Index>(intervals);
    const auto directions = static_cast<Eigen::Index>(inputs.unknowns);
    seed_ = Matrix::Identity(input_count_, directions).replicate(count, 1);
    result_.resizeLike(seed_);
    for (auto row : seed_.rowwise()) seed_rows_.push_back(row.data());
    for (auto row : result_.rowwise()) result_rows_.push_back(row.data());
    trace_on(tag);
    {
      std::vector<RecordedNumber> independents;
      for (std::size_t i = 0; i < seed_rows_.size(); ++i) {
        const auto independent = std::make_shared<adouble>();
        *independent <<= 1.0;
        independents.emplace_back(independent);
      }
      RecordedNumber sum(0.0);
      for (std::size_t k = 0; k < intervals; ++k) {
        const std::span of_interval(&independents[k * inputs.count()], inputs.count());
        sum = sum + replay<RecordedNumber>(lagrangian, of_interval).front();
      }
      double value = 0.0;
      sum.variable() >>= value;
    }
    trace_off();
  }

  /// Intervals `first` .. `first` + `intervals` - 1.
  void evaluate(const BenchmarkedFormulas& point, std::size_t first) {
    // The driver takes its point as double* and only reads it.
    double* independents =
        const_cast<double*>(point.inputs_of(first).data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    const int status = hess_mat(tag_, static_cast<int>(seed_.rows()), static_cast<int>(seed_.cols()), independents,
                                seed_rows_.data(), result_rows_.data());
    if (status < 0) throw Error("ADOL-C's hess_mat failed");
  }
  /// ∂²ℓ/∂z_i∂z_j of interval `first` + `offset` of the last evaluation.
  [[nodiscard]] double entry(std::size_t offset, std::size_t i, std::size_t j) const {
    return result_(static_cast<Eigen::Index>(offset) * input_count_ + static_cast<Eigen::Index>(i),
                   static_cast<Eigen::Index>(j));
  }

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  short tag_;
  Eigen::Index input_count_;  // of one interval
  Matrix seed_;
  Matrix result_;
  std::vector<double*> seed_rows_;
  std::vector<double*> result_rows_;
};

void register_hessian(const std::string& quantity, short tag, const BenchmarkedFormulas& point, std::size_t intervals) {
  const Schedule& lagrangian = point.functions().lagrangian;
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
