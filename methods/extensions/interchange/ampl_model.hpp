#pragma once

#include <string>

#include <Eigen/Core>

#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// A nonlinear program in AMPL's format, for any solver that reads it: the texts of the files STUB.nl, STUB.row and
/// STUB.col.
struct AmplModel {
  std::string nl;   ///< text format g: formulas, bounds, patterns and the start
  std::string row;  ///< what the rows are called, a line each, then the objective
  std::string col;  ///< what the unknowns are called
};

/// The program with the values that it has now, and a start (variable_count() entries). Unknowns and rows stand in the
/// order of the program, so that an answer needs no translation: all of them count as nonlinear. What several formulas
/// of an interval read is a defined variable. Throws `Error` if the start has another size, or at an operation that
/// AMPL lacks.
[[nodiscard]] AmplModel ampl_model(const Transcription& program, const Eigen::VectorXd& start);

}  // namespace dmocbench
