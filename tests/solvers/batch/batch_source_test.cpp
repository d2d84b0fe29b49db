#include "methods/solvers/batch/batch_source.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/solvers/batch/solve_batch.hpp"
#include "tests/solvers/batch/batch_case.hpp"

namespace dmocbench::batch {
namespace {

/// Instances whose search in one thread lasts until another thread searches too, or the patience is over.
class MeetingSource final : public BatchSource {
 public:
  explicit MeetingSource(std::vector<BatchInstance> instances) : instances_(std::move(instances)) {}

  [[nodiscard]] bool begin_generation() override { return !std::exchange(has_begun_, true); }
  [[nodiscard]] bool hand_out(Assignment& assignment) override { return assignment.index < instances_.size(); }
  void search(Assignment& /*assignment*/) const override {
    constexpr std::chrono::seconds patience{10};
    std::unique_lock lock(meeting_);
    threads_.insert(std::this_thread::get_id());
    another_.notify_all();
    has_failed_ =
        has_failed_ || !another_.wait_for(lock, patience, [&] { return has_failed_ || threads_.size() == 2; });
  }
  void fill(Assignment& assignment) override { assignment.instance = instances_[assignment.index]; }
  void take(std::size_t /*index*/, const Solution& solution) override {
    answers_ += is_solved(solution.status) ? 1 : 0;
  }

  [[nodiscard]] bool has_met() const { return threads_.size() == 2 && !has_failed_; }
  [[nodiscard]] std::size_t answers() const { return answers_; }

 private:
  std::vector<BatchInstance> instances_;
  bool has_begun_ = false;
  std::size_t answers_ = 0;
  mutable std::mutex meeting_;
  mutable std::condition_variable another_;
  mutable std::set<std::thread::id> threads_;
  mutable bool has_failed_ = false;
};

/// A search under the lock that hands out instances would keep every other thread from its own.
TEST(BatchSource, IsSearchedBySeveralThreadsAtOnce) {
  Case orbit("orbital_transfer", "dmoc", 1, 8);
  MeetingSource source(orbit.instances(32, 0.02));
  solve_batch_of(source, *orbit.program, lanes_of(*orbit.program), orbit.start, {.threads = 2});
  EXPECT_TRUE(source.has_met());
  EXPECT_EQ(source.answers(), 32U);
}

TEST(BatchSource, GetsAnAnswerToAllItHandedOutWheneverTheBatchIsStopped) {
  Case orbit("orbital_transfer", "dmoc", 1, 8);
  const std::vector<BatchInstance> instances = orbit.instances(64, 0.1);
  const auto next = [&](std::size_t index, BatchInstance& instance) {
    if (index < instances.size()) instance = instances[index];
    return index < instances.size();
  };
  for (int rounds = 1; rounds <= 24; ++rounds) {
    std::set<std::size_t> answered;
    int left = rounds;
    BatchOptions options{.threads = 1};
    options.stop_requested = [&] { return --left <= 0; };
    const auto take = [&](std::size_t index, const Solution& solution) {
      EXPECT_TRUE(answered.insert(index).second);
      EXPECT_EQ(solution.primal.size(), orbit.start.size());
    };
    const BatchSummary summary =
        solve_batch(*orbit.program, lanes_of(*orbit.program), orbit.start, next, take, options);
    EXPECT_EQ(answered.size(), summary.instances) << rounds;
  }
}

TEST(BatchSource, KeepsTheMemoryOfItsThreadsForAllGenerations) {
  constexpr std::size_t count = 200;  // four generations
  Case orbit("orbital_transfer", "dmoc", 1, 8);
  const std::vector<BatchInstance> instances = orbit.instances(count, 0.02);
  std::atomic<std::size_t> made = 0;
  const auto lanes = [&] {
    ++made;
    return lanes_of(*orbit.program)();
  };
  const auto place = [&](std::size_t index, Eigen::VectorXd& here) {
    here = Eigen::VectorXd::Constant(1, static_cast<double>(index));
    return index < count;
  };
  const auto next = [&](std::size_t index, const Solution* /*neighbour*/, BatchInstance& instance) {
    instance = instances[index];
  };
  const auto take = [](std::size_t, const Solution&) {};
  BatchOptions options{.threads = 3};
  solve_batch_from_neighbours(*orbit.program, lanes, orbit.start, place, next, take, options);
  EXPECT_EQ(made, 3U);
}

}  // namespace
}  // namespace dmocbench::batch
