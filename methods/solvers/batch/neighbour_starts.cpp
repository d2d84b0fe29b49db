#include "methods/solvers/batch/neighbour_starts.hpp"

#include <map>
#include <utility>
#include <vector>

#include "methods/solvers/batch/batch_source.hpp"

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
  [[nodiscard]] const Solution* nearest_to(const Eigen::VectorXd& place) const {
    if (solutions_.empty()) return nullptr;
    const auto known = places_.leftCols(static_cast<Eigen::Index>(solutions_.size()));
    Eigen::Index nearest = 0;
    const Eigen::RowVectorXd distances = (known.colwise() - place).colwise().squaredNorm();
    distances.minCoeff(&nearest);
    return &solutions_[static_cast<std::size_t>(nearest)];
  }

 private:
  Eigen::MatrixXd places_;
  std::vector<Solution> solutions_;
};

/// Generations as large as all before them together; the last one begins when there are enough neighbours.
class NeighbourSource final : public BatchSource {
 public:
  NeighbourSource(const PlaceInstance& place, const NextFromNeighbour& next, const TakeSolution& take)
      : place_(place), next_(next), take_(take) {}

  [[nodiscard]] bool begin_generation() override {
    if (is_over_ || is_last_) return false;
    for (auto& [index, solution] : solved_) {
      if (!place_(index, here_)) break;
      neighbours_.add(here_, std::move(solution));
    }
    solved_.clear();
    is_last_ = end_ >= most_neighbours;
    end_ = end_ == 0 ? first_generation : 2 * end_;
    return true;
  }

  [[nodiscard]] bool hand_out(Assignment& assignment) override {
    if (!is_last_ && assignment.index == end_) return false;
    is_over_ = !place_(assignment.index, assignment.coordinates);
    return !is_over_;
  }

  /// No answer is added while a generation is solved.
  void search(Assignment& assignment) const override {
    assignment.neighbour = neighbours_.nearest_to(assignment.coordinates);
  }

  void fill(Assignment& assignment) override { next_(assignment.index, assignment.neighbour, assignment.instance); }

  void take(std::size_t index, const Solution& solution) override {
    if (!is_last_ && is_solved(solution.status)) solved_[index] = solution;
    take_(index, solution);
  }

 private:
  const PlaceInstance& place_;
  const NextFromNeighbour& next_;
  const TakeSolution& take_;
  SolvedInstances neighbours_;
  std::map<std::size_t, Solution> solved_;  // of this generation, in the order of their numbers
  Eigen::VectorXd here_;
  std::size_t end_ = 0;  // of this generation, unless it is the last
  bool is_last_ = false;
  bool is_over_ = false;  // there are no more instances
};

}  // namespace

}  // namespace batch

BatchSummary solve_batch_from_neighbours(NonlinearProgram& program, const MakeLanes& make_lanes,
                                         const Eigen::VectorXd& usual, const PlaceInstance& place,
                                         const NextFromNeighbour& next, const TakeSolution& take,
                                         const BatchOptions& options) {
  batch::NeighbourSource source(place, next, take);
  return batch::solve_batch_of(source, program, make_lanes, usual, options);
}

}  // namespace dmocbench
