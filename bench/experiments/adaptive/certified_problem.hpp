#pragma once

#include <memory>
#include <string>

#include "bench/run/column.hpp"
#include "methods/indirect/indirect_solution.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// A problem with its certified optimum, against which estimates are held.
class CertifiedProblem {
 public:
  /// Solves the problem, without bounds that a parameter can switch off, by the indirect method from a direct solution.
  /// Throws `Error` if that fails.
  CertifiedProblem(std::shared_ptr<const Problem> problem, const SolverOptions& options);

  [[nodiscard]] const Problem& problem() const noexcept { return *problem_; }
  /// Its program by a method, on a uniform grid.
  [[nodiscard]] std::unique_ptr<Transcription> transcribe(const Scheme& scheme, long long intervals) const;
  [[nodiscard]] const IndirectSolution& optimum() const noexcept { return optimum_; }
  /// The optimal motion, from which solves may start.
  [[nodiscard]] const Trajectory& motion() const noexcept { return motion_; }

 private:
  std::shared_ptr<const Problem> problem_;
  IndirectSolution optimum_;
  Trajectory motion_;
};

/// The true error of an answer, optimum minus answer, in the form of an estimate.
struct TrueError {
  double state = 0.0;      ///< the largest |δq_k|
  double momentum = 0.0;   ///< the largest |δp_k|
  double costate = 0.0;    ///< the largest |(δψ^q, δψ^p)_k|
  double objective = 0.0;  ///< |δJ|
  double relative = 0.0;   ///< `relative_size`
};

[[nodiscard]] TrueError true_error(const CertifiedProblem& certified, const Trajectory& answer);

}  // namespace dmocbench
