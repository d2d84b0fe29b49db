#include "methods/solvers/batch/neighbour_starts.hpp"

#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace dmocbench {

namespace batch {

namespace {

constexpr std::size_t first_generation = 64;

struct Neighbour {
  Eigen::VectorXd place;
  Solution solution;
};

/// The first of the nearest ones; null of none.
const Neighbour* nearest_of(const std::vector<Neighbour>& neighbours, const Eigen::VectorXd& place) {
  const Neighbour* nearest = nullptr;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Neighbour& neighbour : neighbours) {
    const double distance = (neighbour.place - place).squaredNorm();
    if (!(distance < smallest)) continue;
    smallest = distance;
    nearest = &neighbour;
  }
  return nearest;
}

void add(BatchSummary& sum, const BatchSummary& summary) {
  sum.instances += summary.instances;
  sum.solved += summary.solved;
  sum.solved_one_by_one += summary.solved_one_by_one;
  sum.rounds += summary.rounds;
  for (std::size_t i = 0; i < sum.seconds.size(); ++i) sum.seconds[i] += summary.seconds[i];
}

}  // namespace

}  // namespace batch

BatchSummary solve_batch_from_neighbours(NonlinearProgram& program, const MakeLanes& make_lanes,
                                         const Eigen::VectorXd& usual, const PlaceInstance& place,
                                         const NextFromNeighbour& next, const TakeSolution& take,
                                         const BatchOptions& options) {
  BatchSummary sum;
  std::vector<batch::Neighbour> neighbours;
  std::size_t begin = 0;
  for (std::size_t generation = batch::first_generation; generation > 0;) {
    const bool is_last = begin >= most_neighbours;
    std::map<std::size_t, batch::Neighbour> solved;  // of this generation, in the order of their numbers
    Eigen::VectorXd here;
    const auto fetch = [&](std::size_t index, BatchInstance& instance) {
      if (!is_last && index == generation) return false;
      if (!place(begin + index, here)) return false;
      const batch::Neighbour* const neighbour = batch::nearest_of(neighbours, here);
      next(begin + index, neighbour == nullptr ? nullptr : &neighbour->solution, instance);
      return true;
    };
    const auto keep = [&](std::size_t index, const Solution& solution) {
      if (!is_last && is_solved(solution.status)) solved[index].solution = solution;
      take(begin + index, solution);
    };
    const BatchSummary summary = solve_batch(program, make_lanes, usual, fetch, keep, options);
    batch::add(sum, summary);
    const bool is_over = is_last || summary.instances < generation;
    for (auto& [index, neighbour] : solved) {
      if (is_over || !place(begin + index, neighbour.place)) break;
      neighbours.push_back(std::move(neighbour));
    }
    begin += summary.instances;
    generation = is_over ? 0 : begin;
  }
  return sum;
}

}  // namespace dmocbench
