#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "methods/program/lane_program.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/solvers/batch/batch.hpp"

namespace dmocbench::batch {

/// An instance with its number.
struct Assignment {
  std::size_t index = 0;
  BatchInstance instance;
  Eigen::VectorXd coordinates;          ///< of `solve_batch_from_neighbours`, as is the next
  const Solution* neighbour = nullptr;  ///< null if there is none
};

/// The source of the instances of a batch and the receiver of their answers, for all threads. Instances come in
/// generations: one begins when all answers to the one before have been taken.
class BatchSource {
 public:
  virtual ~BatchSource() = default;
  BatchSource(const BatchSource&) = delete;
  BatchSource& operator=(const BatchSource&) = delete;
  BatchSource(BatchSource&&) = delete;
  BatchSource& operator=(BatchSource&&) = delete;

  /// Begins the next generation of instances; false if there are no more. It is called while no thread hands out,
  /// solves or takes instances.
  [[nodiscard]] virtual bool begin_generation() = 0;
  /// Describes the next instance, in the order of their numbers; false if the generation has no more. Only one thread
  /// at a time is inside `hand_out` or `fill`.
  [[nodiscard]] virtual bool hand_out(Assignment& assignment) = 0;
  /// The slow part of the description. It changes no data that threads share, so all threads may search at once.
  virtual void search(Assignment& /*assignment*/) const {}
  /// Completes the work of `hand_out`, in any order.
  virtual void fill(Assignment& /*assignment*/) {}
  /// Takes an answer; one thread at a time.
  virtual void take(std::size_t index, const Solution& solution) = 0;

 protected:
  BatchSource() = default;
};

/// `solve_batch` of the instances of a source.
BatchSummary solve_batch_of(BatchSource& source, NonlinearProgram& program, const MakeLanes& make_lanes,
                            const Eigen::VectorXd& usual, const BatchOptions& options);

}  // namespace dmocbench::batch
