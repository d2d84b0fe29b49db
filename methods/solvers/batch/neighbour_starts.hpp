#pragma once

#include <cstddef>
#include <functional>

#include <Eigen/Core>

#include "methods/solvers/batch/solve_batch.hpp"

namespace dmocbench {

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
