#pragma once

#include <cstddef>
#include <functional>

#include <Eigen/Core>

#include "methods/program/lane_program.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/solvers/batch/batch.hpp"

namespace dmocbench {

/// Fetches the next instance into `instance`, whose vectors keep their memory; false if there is none left.
using NextInstance = std::function<bool(std::size_t index, BatchInstance& instance)>;
/// Takes the answer of an instance.
using TakeSolution = std::function<void(std::size_t index, const Solution& solution)>;

/// Solves many instances of a program by the interior-point method, eight at a time in the lanes of vector registers
/// and several such groups on threads; see README.md. An instance that has converged leaves its lane to the next one.
///
/// `next` and `take` are called from several threads, each by one at a time, while `program` is in use: neither may
/// touch it. A thread takes several instances and delivers several answers at a time.
/// Answers come in any order, each with the index of its instance: 0, 1, ... Memory does not grow with their number.
/// An answer depends on its instance alone, to the last digit: neither on its neighbours nor on the number of threads.
/// It is solved only if the residuals of its optimality conditions are below the tolerance, and a Newton step would not
/// move it (`confirm`). An instance of wrong sizes is an "invalid program", one with a number that is not finite an
/// "evaluation failed".
///
/// `usual` is the start of any ordinary instance: the order of elimination is chosen there. Throws `Error` with the
/// reason if the program's structure does not fit: both ends of the horizon and its length must be given. An exception
/// of `next` or `take` ends the batch, and is thrown again.
BatchSummary solve_batch(NonlinearProgram& program, const MakeLanes& make_lanes, const Eigen::VectorXd& usual,
                         const NextInstance& next, const TakeSolution& take, const BatchOptions& options = {});

}  // namespace dmocbench
