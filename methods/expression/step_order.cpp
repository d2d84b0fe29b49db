#include "methods/expression/step_order.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace dmocbench {

namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

/// Cycles from operands to result, about those of present processors. They decide about the order alone.
std::uint32_t latency(VectorOperation operation) {
  switch (operation) {
    case VectorOperation::add:
    case VectorOperation::subtract:
    case VectorOperation::multiply:
      return 4;
    case VectorOperation::divide:
      return 14;
    case VectorOperation::square_root:
      return 20;
    case VectorOperation::exclusive_or:
    case VectorOperation::copy:
      return 1;
  }
  return 1;
}

/// Steps of which each is ordered as a whole with the copies that follow it.
class ListScheduler {
 public:
  ListScheduler(const std::vector<VectorStep>& steps, std::size_t values, std::size_t registers)
      : steps_(steps), most_alive_(registers - std::min(registers, registers_for_operands)), producer_(values, nobody) {
    find_groups();
    link_readers();
    // Readers stand behind what they read.
    for (std::size_t i = groups_.size(); i-- > 0;) {
      Group& group = groups_[i];
      group.way_to_end += latency(steps_[group.first].operation);
      visit_producers(group,
                      [&](Group& producer) { producer.way_to_end = std::max(producer.way_to_end, group.way_to_end); });
    }
  }

  std::vector<VectorStep> order() {
    for (std::uint32_t i = 0; i < groups_.size(); ++i) {
      if (groups_[i].awaited == 0) make_ready(i);
    }
    std::vector<VectorStep> result;
    result.reserve(steps_.size());
    for (std::size_t left = groups_.size(); left > 0; --left, ++time_) {
      const std::uint32_t next = take_next();
      const Group& group = groups_[next];
      for (std::uint32_t i = group.first; i < group.end; ++i) result.push_back(steps_[i]);
      issue(next);
    }
    return result;
  }

 private:
  // Operands from memory and results pass through registers, too.
  static constexpr std::size_t registers_for_operands = 4;

  struct Group {
    std::uint32_t first = 0;  // of its steps
    std::uint32_t end = 0;
    std::uint32_t awaited = 0;     // operands that groups before it have yet to compute
    std::uint32_t unread = 0;      // operands of others that its result has yet to become
    std::uint32_t way_to_end = 0;  // cycles of the longest one
    std::uint32_t known_at = 0;    // the cycle from which its operands are known
    std::uint32_t first_reader = 0;
    bool is_issued = false;
  };
  using Entry = std::pair<std::uint32_t, std::uint32_t>;  // a key, and a group

  void find_groups() {
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      const bool belongs_to_group = steps_[i].operation == VectorOperation::copy && i > 0 &&
                                    steps_[i].left == steps_[groups_.back().first].result &&
                                    steps_[groups_.back().first].operation != VectorOperation::copy;
      if (!belongs_to_group) groups_.push_back({.first = i});
      groups_.back().end = i + 1;
      if (steps_[i].operation != VectorOperation::copy) {
        producer_[steps_[i].result] = static_cast<std::uint32_t>(groups_.size() - 1);
      }
    }
  }

  template <class Visit>
  void visit_producers(const Group& group, const Visit& visit) {
    const VectorStep& step = steps_[group.first];
    if (producer_[step.left] != nobody) visit(groups_[producer_[step.left]]);
    if (operand_count(step.operation) > 1 && producer_[step.right] != nobody) visit(groups_[producer_[step.right]]);
  }

  /// Lists of readers, one behind the other.
  void link_readers() {
    for (Group& group : groups_) {
      visit_producers(group, [&](Group& producer) {
        ++producer.unread;
        ++group.awaited;
      });
    }
    std::uint32_t next = 0;
    for (Group& group : groups_) {
      group.first_reader = next;
      next += group.unread;
    }
    readers_.resize(next);
    std::vector<std::uint32_t> filled(groups_.size());
    for (std::uint32_t i = 0; i < groups_.size(); ++i) {
      visit_producers(groups_[i], [&](Group& producer) {
        readers_[producer.first_reader + filled[static_cast<std::size_t>(&producer - groups_.data())]++] = i;
      });
    }
  }

  void make_ready(std::uint32_t group) {
    waiting_.emplace(groups_[group].known_at, group);
    in_order_.push(group);
  }

  std::uint32_t take_next() {
    if (alive_ >= most_alive_) {
      while (groups_[in_order_.top()].is_issued) in_order_.pop();
      return in_order_.top();
    }
    for (;; time_ = std::max(time_, waiting_.top().first)) {
      for (; !waiting_.empty() && waiting_.top().first <= time_; waiting_.pop()) {
        // Of equal ones the first.
        known_.emplace(groups_[waiting_.top().second].way_to_end, nobody - waiting_.top().second);
      }
      while (!known_.empty() && groups_[nobody - known_.top().second].is_issued) known_.pop();
      if (!known_.empty()) return nobody - known_.top().second;
      while (groups_[waiting_.top().second].is_issued) waiting_.pop();
    }
  }

  void issue(std::uint32_t number) {
    Group& group = groups_[number];
    group.is_issued = true;
    visit_producers(group, [&](Group& producer) { alive_ -= --producer.unread == 0 ? 1 : 0; });
    if (group.unread > 0) ++alive_;
    const std::uint32_t known_at = time_ + latency(steps_[group.first].operation);
    for (std::uint32_t i = group.first_reader; i < group.first_reader + group.unread; ++i) {
      Group& reader = groups_[readers_[i]];
      reader.known_at = std::max(reader.known_at, known_at);
      if (--reader.awaited == 0) make_ready(readers_[i]);
    }
  }

  const std::vector<VectorStep>& steps_;
  const std::size_t most_alive_;
  std::vector<std::uint32_t> producer_;  // the group that computes a value; nobody if it is in memory
  std::vector<Group> groups_;
  std::vector<std::uint32_t> readers_;
  std::uint32_t time_ = 0;
  std::size_t alive_ = 0;  // results that will be read
  std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> in_order_;  // ready ones
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting_;                   // ready ones by cycles
  std::priority_queue<Entry> known_;  // those with operands that are known
};

}  // namespace

std::vector<VectorStep> overlapping_order(const std::vector<VectorStep>& steps, std::size_t values,
                                          std::size_t registers) {
  return ListScheduler(steps, values, registers).order();
}

}  // namespace dmocbench
