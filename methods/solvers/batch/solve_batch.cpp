#include "methods/solvers/batch/solve_batch.hpp"

#include <barrier>
#include <map>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "methods/error.hpp"
#include "methods/kkt/intervals/lane_kkt.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/batch/batch_queue.hpp"
#include "methods/solvers/batch/batch_source.hpp"
#include "methods/solvers/batch/lane_run.hpp"
#include "methods/solvers/solver.hpp"

namespace dmocbench {

namespace batch {

namespace {

/// The functions of a caller as a source with one generation.
class PlainSource final : public BatchSource {
 public:
  PlainSource(const NextInstance& next, const TakeSolution& take) : next_(next), take_(take) {}

  [[nodiscard]] bool begin_generation() override { return !std::exchange(has_begun_, true); }
  [[nodiscard]] bool hand_out(Assignment& assignment) override { return next_(assignment.index, assignment.instance); }
  void take(std::size_t index, const Solution& solution) override { take_(index, solution); }

 private:
  const NextInstance& next_;
  const TakeSolution& take_;
  bool has_begun_ = false;
};

Eigen::VectorXd usual_jacobian(NonlinearProgram& program, const Eigen::VectorXd& usual) {
  if (static_cast<std::size_t>(usual.size()) != program.variable_count()) {
    throw Error("the default start of a batch has {} entries, but the program has {} variables", usual.size(),
                program.variable_count());
  }
  Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  program.jacobian(usual, jacobian);
  return jacobian;
}

/// The elimination of the lanes of a thread; the same order in all threads.
std::unique_ptr<kkt::LaneKkt> make_kkt(const NonlinearProgram& program, const Eigen::VectorXd& jacobian) {
  const Eigen::VectorXd hessian = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.hessian_structure().size()));
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.variable_count()));
  const Eigen::VectorXd compliance = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.constraint_count()));
  auto made = kkt::LaneKkt::make(program, {hessian, jacobian, diagonal, compliance});
  if (!made) throw Error("this program cannot be solved in a batch: {}", made.error());
  return std::move(*made);
}

}  // namespace

/// Every thread sets up its own memory, once. None begins before all have: they read the program, which belongs to one
/// thread at a time as soon as threads work.
BatchSummary solve_batch_of(BatchSource& source, NonlinearProgram& program, const MakeLanes& make_lanes,
                            const Eigen::VectorXd& usual, const BatchOptions& options) {
  SolverOptions single;
  single.tolerance = options.tolerance;
  single.most_iterations = options.most_iterations;
  single.most_seconds = options.most_seconds;
  single.validate();
  const std::size_t threads = options.threads > 0 ? options.threads : thread_count();
  const Eigen::VectorXd jacobian = usual_jacobian(program, usual);
  SharedBatch batch(program, source, options);
  std::barrier generations(static_cast<std::ptrdiff_t>(threads), [&]() noexcept { batch.begin_generation(); });
  const auto work = [&] {
    std::optional<LaneRun> run;
    batch.guard([&] { run.emplace(batch, make_lanes(), make_kkt(program, jacobian)); });
    while (true) {
      generations.arrive_and_wait();
      if (batch.has_ended()) return;
      batch.guard([&] { run->run(); });
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < threads; ++i) {
      try {
        helpers.emplace_back(work);
      } catch (const std::system_error&) {  // the system has no more threads
        generations.arrive_and_drop();
      }
    }
    work();
  }
  return batch.summary();
}

}  // namespace batch

BatchSummary solve_batch(NonlinearProgram& program, const MakeLanes& make_lanes, const Eigen::VectorXd& usual,
                         const NextInstance& next, const TakeSolution& take, const BatchOptions& options) {
  batch::PlainSource source(next, take);
  return batch::solve_batch_of(source, program, make_lanes, usual, options);
}

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
