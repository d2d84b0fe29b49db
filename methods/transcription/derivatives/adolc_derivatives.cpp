#include <algorithm>
#include <memory>

#include "methods/expression/replay.hpp"
#include "methods/transcription/derivatives/adolc_recording.hpp"
#include "methods/transcription/derivatives/derivative_back_end.hpp"
#include "methods/transcription/derivatives/recorded_number.hpp"

namespace dmocbench {

namespace {

/// Formulas that ADOL-C has recorded under their own number.
class Recording {
 public:
  explicit Recording(const Schedule& schedule)
      : tag_(schedule.input_count() > 0),
        output_count_(static_cast<int>(schedule.outputs().size())),
        point_(schedule.input_count()) {
    trace_on(tag());
    {
      std::vector<RecordedNumber> inputs;
      for (std::size_t i = 0; i < point_.size(); ++i) {
        const auto independent = std::make_shared<adouble>();
        *independent <<= 1.0;
        inputs.emplace_back(independent);
      }
      for (const RecordedNumber& output : replay<RecordedNumber>(schedule, std::span<const RecordedNumber>(inputs))) {
        adouble dependent = output.variable();
        double value = 0.0;
        dependent >>= value;
      }
    }
    trace_off();
  }

  [[nodiscard]] short tag() const noexcept { return tag_.number(); }
  [[nodiscard]] int input_count() const noexcept { return static_cast<int>(point_.size()); }
  [[nodiscard]] int output_count() const noexcept { return output_count_; }
  /// The inputs of one interval, one after the other.
  [[nodiscard]] double* point(DerivativeBackEnd::Inputs inputs, std::size_t interval) {
    for (std::size_t i = 0; i < point_.size(); ++i) point_[i] = inputs[i].data[inputs[i].same_for_all ? 0 : interval];
    return point_.data();
  }

 private:
  AdolcTag tag_;
  int output_count_;
  std::vector<double> point_;
};

/// Exact derivatives by ADOL-C, which differentiates the values of an interval (cost, constraints, ℓ).
///
/// Each is recorded once per back end, with constants passive; an evaluation then calls ADOL-C's dense driver interval
/// after interval (`gradient`, `jacobian`, and `hess_mat` in the directions of the local unknowns) and keeps the
/// entries that are not zero for every motion. Step, time, factor and multipliers are further independent variables.
/// Its drivers end the program where there is nothing to differentiate (the ends of the horizon without conditions, an
/// interval without a cost), so they are not called there. ADOL-C allocates in its drivers, and its recordings are
/// global: two threads must not use such back ends at once.
class AdolcDerivatives final : public DerivativeBackEnd {
 public:
  AdolcDerivatives(const LocalFunctions& functions, const DerivativePlaces& places)
      : cost_(functions.cost),
        rows_(functions.rows.schedule),
        lagrangian_(functions.lagrangian),
        gradient_unknowns_(functions.gradient.places),
        jacobian_columns_(functions.jacobian.columns),
        hessian_rows_(functions.hessian.rows),
        hessian_columns_(functions.hessian.columns),
        gradient_(places.gradient),
        jacobian_(places.jacobian),
        hessian_(places.hessian),
        cost_gradient_(functions.inputs.count()),
        rows_jacobian_(rows_.output_count(), rows_.input_count()),
        directions_(static_cast<int>(functions.inputs.unknowns)),
        seeds_(height_of(functions, lagrangian_), directions_),
        seeded_hessian_(height_of(functions, lagrangian_), directions_) {
    std::vector<std::size_t> output_of_row(functions.inputs.rows);
    for (std::size_t o = 0; o < functions.rows.places.size(); ++o) output_of_row[functions.rows.places[o]] = o;
    const std::size_t first = functions.inputs.unknown(0);
    for (std::vector<std::size_t>* inputs : {&gradient_unknowns_, &jacobian_columns_, &hessian_rows_}) {
      for (std::size_t& input : *inputs) input += first;
    }
    for (const std::size_t row : functions.jacobian.rows) jacobian_outputs_.push_back(output_of_row[row]);
    for (std::size_t a = 0; a < functions.inputs.unknowns; ++a) seeds_(first + a, a) = 1.0;
  }

  void gradient(Inputs inputs, VectorOut result) override {
    const auto columns = gradient_.open(result);
    for (std::size_t k = 0; k < gradient_.intervals() && !columns.empty(); ++k) {
      require_adolc(::gradient(cost_.tag(), cost_.input_count(), cost_.point(inputs, k), cost_gradient_.data()),
                    "gradient");
      for (std::size_t e = 0; e < columns.size(); ++e) columns[e][k] = cost_gradient_[gradient_unknowns_[e]];
    }
    gradient_.close(result);
  }

  void jacobian(Inputs inputs, VectorOut values) override {
    const auto columns = jacobian_.open(values);
    for (std::size_t k = 0; k < jacobian_.intervals() && !columns.empty(); ++k) {
      require_adolc(::jacobian(rows_.tag(), rows_.output_count(), rows_.input_count(), rows_.point(inputs, k),
                               rows_jacobian_.rows()),
                    "jacobian");
      for (std::size_t e = 0; e < columns.size(); ++e) {
        columns[e][k] = rows_jacobian_(jacobian_outputs_[e], jacobian_columns_[e]);
      }
    }
    jacobian_.close(values);
  }

  void hessian(Inputs inputs, VectorOut values) override {
    const auto columns = hessian_.open(values);
    for (std::size_t k = 0; k < hessian_.intervals() && !columns.empty(); ++k) {
      require_adolc(hess_mat(lagrangian_.tag(), lagrangian_.input_count(), directions_, lagrangian_.point(inputs, k),
                             seeds_.rows(), seeded_hessian_.rows()),
                    "hess_mat");
      for (std::size_t e = 0; e < columns.size(); ++e) {
        columns[e][k] = seeded_hessian_(hessian_rows_[e], hessian_columns_[e]);
      }
    }
    hessian_.close(values);
  }

 private:
  /// Rows of a matrix whose columns are the local unknowns, all of which it has.
  static int height_of(const LocalFunctions& functions, const Recording& lagrangian) {
    return std::max(lagrangian.input_count(), static_cast<int>(functions.inputs.step()));
  }

  Recording cost_;
  Recording rows_;
  Recording lagrangian_;
  // Per entry, inputs or outputs of the recordings; the columns of the Hessian are directions.
  std::vector<std::size_t> gradient_unknowns_;
  std::vector<std::size_t> jacobian_outputs_;
  std::vector<std::size_t> jacobian_columns_;
  std::vector<std::size_t> hessian_rows_;
  std::vector<std::size_t> hessian_columns_;
  SeriesAssembly gradient_;
  SeriesAssembly jacobian_;
  SeriesAssembly hessian_;
  std::vector<double> cost_gradient_;
  AdolcMatrix rows_jacobian_;
  int directions_;
  AdolcMatrix seeds_;
  AdolcMatrix seeded_hessian_;
};

}  // namespace

// Declared where it is used, in derivative_back_end.cpp: builds without ADOL-C have no such function.
std::unique_ptr<DerivativeBackEnd> make_adolc_derivatives(const LocalFunctions& functions,
                                                          const DerivativePlaces& places) {
  return std::make_unique<AdolcDerivatives>(functions, places);
}

}  // namespace dmocbench
