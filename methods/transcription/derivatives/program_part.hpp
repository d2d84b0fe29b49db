#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "methods/transcription/derivatives/derivative_back_end.hpp"
#include "methods/transcription/derivatives/local_functions.hpp"
#include "methods/transcription/derivatives/part_places.hpp"
#include "methods/transcription/derivatives/series_assembly.hpp"

namespace dmocbench {

/// A part of a program on numbers: the functions of an interval for all intervals, or of the ends. Its inputs are
/// the program's own vectors, read in place. Evaluations do not allocate.
class ProgramPart {
 public:
  /// `steps` and `times`, one entry per interval, and `parameters`, one per open parameter, or of each one per
  /// interval, are read in every evaluation and must outlive this object. `derivatives` names a back end, see
  /// `make_derivative_back_end` (back_ends.hpp).
  ProgramPart(const LocalFunctions& functions, PartPlaces places, const Eigen::VectorXd& steps,
              const Eigen::VectorXd& times, const Eigen::VectorXd& parameters, std::string_view derivatives);
  // Inputs point into this object.
  ProgramPart(const ProgramPart&) = delete;
  ProgramPart& operator=(const ProgramPart&) = delete;
  ~ProgramPart() = default;

  /// The inputs of the formulas at a point (see `LocalInputs`); `multipliers` may be empty where no formula reads them.
  /// Valid until the next call.
  [[nodiscard]] std::span<const Tape::Input> bind(const VectorIn& x, const VectorIn& multipliers,
                                                  double objective_factor);

  /// Its share of φ, interval by interval. Valid until the next call.
  [[nodiscard]] const Eigen::VectorXd& costs(const VectorIn& x);
  /// Their sum.
  [[nodiscard]] double cost(const VectorIn& x) { return costs(x).sum(); }
  // These write the program's whole arrays, or add to them.
  /// a, constraint_count() entries.
  void rows(const VectorIn& x, const VectorOut& result);
  /// ∇φ, variable_count() entries.
  void gradient(const VectorIn& x, const VectorOut& result);
  /// The entries of ∂a/∂ξ.
  void jacobian(const VectorIn& x, const VectorOut& values);
  /// The entries of the Hessian of objective_factor · φ + λᵀa.
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, const VectorOut& values);

 private:
  LocalInputs numbers_;
  std::vector<SeriesPlace> unknown_places_;
  std::vector<SeriesPlace> row_places_;
  double objective_factor_ = 1.0;
  Eigen::VectorXd no_multipliers_;
  std::vector<Tape::Input> inputs_;
  AssembledTape cost_;
  AssembledTape rows_;
  std::unique_ptr<DerivativeBackEnd> derivatives_;
  Eigen::VectorXd costs_;  // per interval
};

}  // namespace dmocbench
