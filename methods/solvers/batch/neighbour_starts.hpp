#pragma once

#include <cstddef>
#include <functional>

#include <Eigen/Core>

#include "methods/solvers/batch/solve_batch.hpp"

namespace dmocbench {

/// Where an instance lies among the others: `coordinates`, equally many of all, in units in which distances in all
/// directions count alike. False if there is no such instance.
using PlaceInstance = std::function<bool(std::size_t index, Eigen::VectorXd& coordinates)>;
/// Fills an instance, warm from the answer of its nearest neighbour; null for those that have none and start as they
/// would without.
using NextFromNeighbour = std::function<void(std::size_t index, const Solution* neighbour, BatchInstance& instance)>;

/// How many answers are kept as neighbours at most.
inline constexpr std::size_t most_neighbours = 512;

/// `solve_batch` of instances that start from the nearest solved one of those before them.
///
/// They are solved in generations: the first 64 without neighbours, then as many as there are already, each from the
/// nearest of all generations before, until `most_neighbours` are known; the others are the last generation. Which
/// instance starts from which depends on their order alone, so that answers do not depend on the number of threads.
/// `place` and `next` are called as `NextInstance` is; `next` is free to move the neighbour's answer to the ends of the
/// instance. Throws as `solve_batch` does.
BatchSummary solve_batch_from_neighbours(NonlinearProgram& program, const MakeLanes& make_lanes,
                                         const Eigen::VectorXd& usual, const PlaceInstance& place,
                                         const NextFromNeighbour& next, const TakeSolution& take,
                                         const BatchOptions& options = {});

}  // namespace dmocbench
