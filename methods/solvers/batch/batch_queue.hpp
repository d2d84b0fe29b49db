#pragma once

#include <cstddef>

#include "methods/program/solution.hpp"
#include "methods/solvers/batch/solve_batch.hpp"

namespace dmocbench::batch {

/// An instance with its number.
struct Assignment {
  std::size_t index = 0;
  BatchInstance instance;
};

/// Where the groups of lanes, each on a thread of its own, fetch instances and leave answers.
class BatchQueue {
 public:
  virtual ~BatchQueue() = default;
  BatchQueue(const BatchQueue&) = delete;
  BatchQueue& operator=(const BatchQueue&) = delete;
  BatchQueue(BatchQueue&&) = delete;
  BatchQueue& operator=(BatchQueue&&) = delete;

  /// The next instance that lanes can begin with; false if there is none left.
  [[nodiscard]] virtual bool fetch(Assignment& assignment) = 0;
  virtual void deliver(std::size_t index, const Solution& solution) = 0;
  /// Solves an instance that the lanes cannot finish, and delivers the answer.
  virtual void solve_one_by_one(const Assignment& assignment, const Solution& so_far) = 0;
  /// `confirm` of an answer.
  virtual void confirm(const Assignment& assignment, Solution& solution) = 0;
  [[nodiscard]] virtual bool is_stopped() = 0;
  virtual void count_round() = 0;
  /// Where the time of a thread went.
  virtual void add_seconds(const BatchSeconds& seconds) = 0;

 protected:
  BatchQueue() = default;
};

}  // namespace dmocbench::batch
