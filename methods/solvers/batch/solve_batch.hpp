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

/// Sets the `coordinates` of an instance, by which the nearest neighbour is found: the same number for every instance,
/// in units that make distances in all directions comparable. False if the instance does not exist.
using PlaceInstance = std::function<bool(std::size_t index, Eigen::VectorXd& coordinates)>;
/// Fills an instance whose start is the answer of its nearest neighbour. `neighbour` is null if there is none; the
/// instance then starts as in `solve_batch`.
using NextFromNeighbour = std::function<void(std::size_t index, const Solution* neighbour, BatchInstance& instance)>;

/// The most answers that are kept as neighbours.
inline constexpr std::size_t most_neighbours = 512;

/// `solve_batch` of instances that start from the nearest solved one of those before them.
///
/// They are solved in generations: the first 64 without neighbours, then as many as there are already, each from the
/// nearest of all generations before, until `most_neighbours` are known; the others are the last generation. Which
/// instance starts from which depends on their order alone, so that answers do not depend on the number of threads.
/// `place` and `next` are called as `NextInstance` is, but `next` in any order; it is free to move the neighbour's
/// answer to the ends of the instance. The search for the nearest is the work of all threads at once. Throws as
/// `solve_batch` does.
BatchSummary solve_batch_from_neighbours(NonlinearProgram& program, const MakeLanes& make_lanes,
                                         const Eigen::VectorXd& usual, const PlaceInstance& place,
                                         const NextFromNeighbour& next, const TakeSolution& take,
                                         const BatchOptions& options = {});

}  // namespace dmocbench
