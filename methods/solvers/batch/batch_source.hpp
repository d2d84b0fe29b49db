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

/// One instance of a program as a program of its own: fixed unknowns have the values of its start, equalities its
/// values. For work done one by one; the program that evaluates must outlive it.
class InstanceProgram final : public ForwardingProgram {
 public:
  /// `start`: variable_count() entries; `equality_values`: constraint_count() entries, or none for the values of the
  /// program.
  InstanceProgram(NonlinearProgram& program, const Eigen::VectorXd& start, const Eigen::VectorXd& equality_values)
      : ForwardingProgram(program),
        variable_lower_(with_values(program.variable_lower(), program.variable_upper(), start)),
        variable_upper_(with_values(program.variable_upper(), program.variable_lower(), start)),
        constraint_lower_(with_values(program.constraint_lower(), program.constraint_upper(), equality_values)),
        constraint_upper_(with_values(program.constraint_upper(), program.constraint_lower(), equality_values)) {}

  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return variable_lower_; }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return variable_upper_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return constraint_lower_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return constraint_upper_; }

 private:
  /// A bound, with other values where both sides are equal.
  static Eigen::VectorXd with_values(const Eigen::VectorXd& side, const Eigen::VectorXd& other,
                                     const Eigen::VectorXd& values) {
    if (values.size() == 0) return side;
    return (side.array() == other.array()).select(values, side);
  }

  Eigen::VectorXd variable_lower_;
  Eigen::VectorXd variable_upper_;
  Eigen::VectorXd constraint_lower_;
  Eigen::VectorXd constraint_upper_;
};

}  // namespace dmocbench::batch
