#pragma once

#include <memory>
#include <string>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/grid.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// One solve: a problem, a method with its tableau, a solver, its derivatives and a grid.
struct Case {
  std::shared_ptr<const Problem> problem;
  std::string method;
  std::string tableau;
  int stages = 1;
  std::string solver = {};
  std::string derivatives = "tape";  ///< the back end that the solver sees
  Grid grid = Grid::uniform(1);
  std::string variant = {};  ///< what an experiment varies besides; empty in most
  CostForm form = CostForm::bolza;

  [[nodiscard]] std::size_t intervals() const { return grid.intervals(); }
  /// The nonlinear program of this case. Throws `Error` as `Transcription` does.
  [[nodiscard]] std::unique_ptr<Transcription> transcribe() const;
  /// "orbital_transfer dmoc gauss 1 ipopt tape N = 64".
  [[nodiscard]] std::string label() const;
  /// The same as part of a file's name: "orbital_transfer_dmoc_gauss1_64", with the derivatives behind if they
  /// are not those of the tape.
  [[nodiscard]] std::string file_label() const;
  /// True if both differ in their grid only: points of one curve.
  [[nodiscard]] bool same_curve(const Case& other) const;
};

}  // namespace dmocbench
