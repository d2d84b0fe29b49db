#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The names of a program's unknowns in AMPL's files, in the order of the program: `theta[3]` at node 3, `v_theta`
/// or `p_theta` there, `rate_1_theta[3]` of stage 1 in interval 3 (of the second half of the state `rate_1_v_theta`),
/// `tau[3]` of a control, `tau_2[3]` of stage 2 where there are several, `cost_so_far[3]` in Mayer form,
/// `v_theta_first`, `v_theta_last` and `T` where they are unknowns. Spaces in a problem's names become underscores.
[[nodiscard]] std::vector<std::string> ampl_variable_names(const Transcription& program);

/// The names of its rows: `node_theta[3]` of node 3, `equation_2[3]` of interval 3 (the element's own, counted from
/// 1), `path_2[3]` (bounded velocities, then path constraints, stage by stage), `cost_row[3]` in Mayer form,
/// `momentum_theta_first` and `_last` of an end, `condition_1` of the ends.
[[nodiscard]] std::vector<std::string> ampl_row_names(const Transcription& program);

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
