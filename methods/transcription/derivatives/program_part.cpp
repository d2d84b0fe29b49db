#include "methods/transcription/derivatives/program_part.hpp"

#include "methods/transcription/derivatives/back_ends.hpp"

namespace dmocbench {

ProgramPart::ProgramPart(const LocalFunctions& functions, PartPlaces places, const Eigen::VectorXd& steps,
                         const Eigen::VectorXd& times, const Eigen::VectorXd& parameters, std::string_view derivatives)
    : numbers_(functions.inputs),
      unknown_places_(places.derivatives.unknowns),
      row_places_(places.derivatives.rows),
      inputs_(functions.inputs.count()),
      cost_(functions.cost, {{0}, places.constraints.intervals, places.constraints.intervals}),
      rows_(functions.rows.schedule, places.constraints),
      derivatives_(make_derivative_back_end(derivatives, functions, places.derivatives)),
      costs_(static_cast<Eigen::Index>(places.constraints.intervals)) {
  const std::size_t intervals = places.constraints.intervals;
  const bool are_own = static_cast<std::size_t>(parameters.size()) == intervals * numbers_.parameters;
  for (std::size_t i = 0; i < numbers_.parameters; ++i) {
    inputs_[i] = {parameters.data() + (are_own ? i * intervals : i), !are_own};
  }
  inputs_[numbers_.step()] = {steps.data(), false};
  inputs_[numbers_.time()] = {times.data(), false};
  inputs_[numbers_.objective_factor()] = {&objective_factor_, true};
}

std::span<const Tape::Input> ProgramPart::bind(const VectorIn& x, const VectorIn& multipliers,
                                               double objective_factor) {
  for (std::size_t a = 0; a < numbers_.unknowns; ++a) {
    inputs_[numbers_.unknown(a)] = {x.data() + unknown_places_[a].first, unknown_places_[a].is_global};
  }
  objective_factor_ = objective_factor;
  for (std::size_t r = 0; r < numbers_.rows && multipliers.size() > 0; ++r) {
    inputs_[numbers_.multiplier(r)] = {multipliers.data() + row_places_[r].first, false};
  }
  return inputs_;
}

const Eigen::VectorXd& ProgramPart::costs(const VectorIn& x) {
  cost_.evaluate(bind(x, no_multipliers_, 1.0), costs_);
  return costs_;
}

void ProgramPart::rows(const VectorIn& x, const VectorOut& result) {
  rows_.evaluate(bind(x, no_multipliers_, 1.0), result);
}

void ProgramPart::gradient(const VectorIn& x, const VectorOut& result) {
  derivatives_->gradient(bind(x, no_multipliers_, 1.0), result);
}

void ProgramPart::jacobian(const VectorIn& x, const VectorOut& values) {
  derivatives_->jacobian(bind(x, no_multipliers_, 1.0), values);
}

void ProgramPart::hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers,
                          const VectorOut& values) {
  derivatives_->hessian(bind(x, multipliers, objective_factor), values);
}

}  // namespace dmocbench
