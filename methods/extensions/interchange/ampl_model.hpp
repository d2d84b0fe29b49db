#pragma once

#include <string>

#include <Eigen/Core>

#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// A nonlinear program in AMPL's format, for any solver that reads it: the texts of the files STUB.nl, STUB.row and
/// STUB.col.
struct AmplModel {
  std::string nl;   ///< text format g: formulas, bounds, patterns and the start
  std::string row;  ///< names of the rows, a line each, then of the objective
  std::string col;  ///< names of the unknowns
};

/// The program with the values that it has now, and a start (variable_count() entries). Unknowns and rows stand in the
/// order of the program, so that an answer needs no translation: all of them count as nonlinear. A quantity that
/// several formulas of an interval use is a defined variable. Throws `Error` if the start has another size, or at an
/// operation that AMPL lacks.
[[nodiscard]] AmplModel ampl_model(const Transcription& program, const Eigen::VectorXd& start);

}  // namespace dmocbench
