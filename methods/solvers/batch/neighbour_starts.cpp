#include "methods/solvers/batch/neighbour_starts.hpp"

#include <map>
#include <utility>
#include <vector>

namespace dmocbench {

namespace batch {

namespace {

constexpr std::size_t first_generation = 64;

/// The answers that others may start from, and where they lie: a column each.
class SolvedInstances {
 public:
  void add(const Eigen::VectorXd& place, Solution solution) {
    if (solutions_.empty()) places_.resize(place.size(), static_cast<Eigen::Index>(most_neighbours));
    places_.col(static_cast<Eigen::Index>(solutions_.size())) = place;
    solutions_.push_back(std::move(solution));
  }
  /// Null of none.
  [[nodiscard]] const Solution* nearest_to(const Eigen::VectorXd& place) {
    if (solutions_.empty()) return nullptr;
    const auto known = places_.leftCols(static_cast<Eigen::Index>(solutions_.size()));
    Eigen::Index nearest = 0;
    distances_ = (known.colwise() - place).colwise().squaredNorm();
    distances_.minCoeff(&nearest);
    return &solutions_[static_cast<std::size_t>(nearest)];
  }

 private:
  Eigen::MatrixXd places_;
  Eigen::RowVectorXd distances_;
  std::vector<Solution> solutions_;
};

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
  batch::SolvedInstances neighbours;
  std::size_t begin = 0;
  for (std::size_t generation = batch::first_generation; generation > 0;) {
    const bool is_last = begin >= most_neighbours;
    std::map<std::size_t, Solution> solved;  // of this generation, in the order of their numbers
    Eigen::VectorXd here;
    const auto fetch = [&](std::size_t index, BatchInstance& instance) {
      if (!is_last && index == generation) return false;
      if (!place(begin + index, here)) return false;
      next(begin + index, neighbours.nearest_to(here), instance);
      return true;
    };
    const auto keep = [&](std::size_t index, const Solution& solution) {
      if (!is_last && is_solved(solution.status)) solved[index] = solution;
      take(begin + index, solution);
    };
    const BatchSummary summary = solve_batch(program, make_lanes, usual, fetch, keep, options);
    batch::add(sum, summary);
    const bool is_over = is_last || summary.instances < generation;
    for (auto& [index, solution] : solved) {
      if (is_over || !place(begin + index, here)) break;
      neighbours.add(here, std::move(solution));
    }
    begin += summary.instances;
    generation = is_over ? 0 : begin;
  }
  return sum;
}

}  // namespace dmocbench
