#include <algorithm>

#include "methods/transcription/derivatives/finite_differences.hpp"
#include "methods/transcription/derivatives/part_places.hpp"
#include "methods/transcription/derivatives/whole_part.hpp"

namespace dmocbench {

namespace {

class DenseDifferences final : public DerivativeBackEnd {
 public:
  DenseDifferences(const LocalFunctions& functions, const DerivativePlaces& places)
      : part_(functions, places),
        plans_(places),
        first_(functions.inputs.unknown(0)),
        by_column_(part_.unknowns.size()),
        costs_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(part_.intervals))),
        rows_(Eigen::VectorXd::Zero(length(part_.rows))),
        moved_rows_(rows_),
        along_(part_.unknowns.size()),
        x_(Eigen::VectorXd::Zero(length(part_.unknowns))),
        inputs_(functions.inputs.count()),
        cost_tape_(functions.cost, {{0}, part_.intervals, part_.intervals}),
        lagrangian_tape_(functions.lagrangian, {{0}, part_.intervals, part_.intervals}),
        row_tape_(functions.rows.schedule, {picked(places.rows, functions.rows.places),
                                            static_cast<std::size_t>(rows_.size()), part_.intervals}) {
    for (const WholePart::Entry& entry : part_.jacobian) by_column_[entry.column].push_back(entry);
    original_ = x_;
  }

  void gradient(Inputs inputs, VectorOut result) override {
    bind(inputs);
    begin_whole(plans_.gradient, result);
    if (part_.gradient.empty()) return;
    const double before = value(cost_tape_);
    for (const std::size_t j : part_.gradient) {
      const double step = move(j, first_step_);
      result[place(j)] += (value(cost_tape_) - before) / step;
      restore(j);
    }
  }

  void jacobian(Inputs inputs, VectorOut values) override {
    bind(inputs);
    begin_whole(plans_.jacobian, values);
    row_tape_.evaluate(inputs_, rows_);
    for (std::size_t j = 0; j < by_column_.size(); ++j) {
      const double step = move(j, first_step_);
      row_tape_.evaluate(inputs_, moved_rows_);
      for (const WholePart::Entry& entry : by_column_[j]) {
        const auto row = static_cast<Eigen::Index>(part_.rows[entry.row]);
        values[static_cast<Eigen::Index>(entry.value)] += (moved_rows_[row] - rows_[row]) / step;
      }
      restore(j);
    }
  }

  void hessian(Inputs inputs, VectorOut values) override {
    bind(inputs);
    begin_whole(plans_.hessian, values);
    const double middle = value(lagrangian_tape_);
    for (std::size_t j = 0; j < along_.size(); ++j) {
      static_cast<void>(move(j, second_step_));
      along_[j] = value(lagrangian_tape_);
      restore(j);
    }
    for (const auto& [entry, i, j] : part_.hessian) {
      const double s = move(i, second_step_);
      const double t = move(j, second_step_);
      const double corner = value(lagrangian_tape_);
      values[static_cast<Eigen::Index>(entry)] += ((corner - along_[i]) - (along_[j] - middle)) / (s * t);
      restore(i);
      restore(j);
    }
  }

 private:
  /// Of a vector of the program that has entries at these places.
  static Eigen::Index length(const std::vector<std::size_t>& places) {
    return places.empty() ? 0 : static_cast<Eigen::Index>(places.back()) + 1;
  }
  [[nodiscard]] Eigen::Index place(std::size_t j) const { return static_cast<Eigen::Index>(part_.unknowns[j]); }

  /// Copies the unknowns, so that they can be moved; all other inputs are read where they are.
  void bind(Inputs inputs) {
    std::ranges::copy(inputs, inputs_.begin());
    for (std::size_t a = 0; a < part_.unknown_series.size(); ++a) {
      const SeriesPlace& series = part_.unknown_series[a];
      const Tape::Input& given = inputs[first_ + a];
      for (std::size_t k = 0; k < part_.intervals; ++k) {
        x_[static_cast<Eigen::Index>(series.at(k))] = given.data[given.same_for_all ? 0 : k];
      }
      inputs_[first_ + a] = {x_.data() + series.first, series.is_global};
    }
    original_ = x_;
  }

  /// Moves an unknown from where it is and returns by how much.
  double move(std::size_t j, double relative_step) {
    double& x = x_[place(j)];
    const double before = x;
    x += relative_step * std::max(1.0, std::abs(original_[place(j)]));
    return x - before;
  }
  void restore(std::size_t j) { x_[place(j)] = original_[place(j)]; }

  /// The sum over all intervals.
  double value(AssembledTape& tape) {
    tape.evaluate(inputs_, costs_);
    return costs_.sum();
  }

  const double first_step_ = difference_step(DifferenceKind::forward, 1);
  const double second_step_ = difference_step(DifferenceKind::forward, 2);
  WholePart part_;
  DerivativePlaces plans_;
  std::size_t first_;  // of the inputs that are unknowns
  std::vector<std::vector<WholePart::Entry>> by_column_;
  Eigen::VectorXd costs_;  // per interval
  Eigen::VectorXd rows_;
  Eigen::VectorXd moved_rows_;
  std::vector<double> along_;  // ℓ with each unknown moved
  Eigen::VectorXd x_;
  Eigen::VectorXd original_;
  std::vector<Tape::Input> inputs_;  // with unknowns from x_
  AssembledTape cost_tape_;
  AssembledTape lagrangian_tape_;
  AssembledTape row_tape_;
};

}  // namespace

std::unique_ptr<DerivativeBackEnd> make_dense_differences(const LocalFunctions& functions,
                                                          const DerivativePlaces& places) {
  return std::make_unique<DenseDifferences>(functions, places);
}

}  // namespace dmocbench
