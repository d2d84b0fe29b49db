#include "methods/expression/native/step_order.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

namespace dmocbench {

namespace {

// In longer stages registers are full nearly all the time, which leaves little to choose.
constexpr std::size_t most_steps = 1024;

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

/// Cycles from operands to result, about as on present processors. They decide only the order.
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
    known_later_.fill(nobody);
    find_groups();
    link_readers();
    // Readers stand after their operands.
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
    for (std::size_t left = groups_.size(); left > 0; --left) {
      const std::uint32_t next = take_next();
      const Group& group = groups_[next];
      for (std::uint32_t i = group.first; i < group.end; ++i) result.push_back(steps_[i]);
      issue(next);
      pass_cycle();
    }
    return result;
  }

 private:
  // Operands from memory and results pass through registers, too.
  static constexpr std::size_t registers_for_operands = 4;
  static constexpr std::size_t cycles_ahead = 32;  // more than any latency

  struct Group {
    std::uint32_t first = 0;  // of its steps
    std::uint32_t end = 0;
    std::uint32_t awaited = 0;     // operands that groups before it have yet to compute
    std::uint32_t unread = 0;      // operands of others that its result has yet to become
    std::uint32_t way_to_end = 0;  // cycles of the longest one
    std::uint32_t known_at = 0;    // the cycle from which its operands are known
    std::uint32_t first_reader = 0;
    std::uint32_t next_known = nobody;  // another one whose operands are known from the same cycle
    bool is_issued = false;
  };

  void find_groups() {
    groups_.reserve(steps_.size());
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

  /// Lists of readers, one after the other.
  void link_readers() {
    for (Group& group : groups_) {
      visit_producers(group, [&](Group& producer) {
        ++producer.unread;
        ++group.awaited;
      });
    }
    std::uint32_t next = 0;
    for (Group& group : groups_) {
      next += group.unread;
      group.first_reader = next;  // filled from the end
    }
    readers_.resize(next);
    for (std::uint32_t i = 0; i < groups_.size(); ++i) {
      visit_producers(groups_[i], [&](Group& producer) { readers_[--producer.first_reader] = i; });
    }
  }

  void make_ready(std::uint32_t number) {
    if (groups_[number].known_at <= time_) {
      make_known(number);
    } else {
      std::uint32_t& first = known_later_[groups_[number].known_at % cycles_ahead];
      groups_[number].next_known = std::exchange(first, number);
    }
  }
  void make_known(std::uint32_t number) {
    constexpr int bits = 32;
    known_.push(std::uint64_t{groups_[number].way_to_end} << bits | (nobody - number));  // of equal ones the first
  }
  void pass_cycle() {
    ++time_;
    std::uint32_t number = std::exchange(known_later_[time_ % cycles_ahead], nobody);
    for (; number != nobody; number = groups_[number].next_known) make_known(number);
  }

  std::uint32_t take_next() {
    while (groups_[first_left_].is_issued) ++first_left_;
    if (alive_ >= most_alive_) return first_left_;  // all that it reads stood before it
    for (;; pass_cycle()) {
      for (; !known_.empty(); known_.pop()) {
        const std::uint32_t number = nobody - static_cast<std::uint32_t>(known_.top());
        if (!groups_[number].is_issued) return number;
      }
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
  std::vector<std::uint32_t> producer_;  // the group that computes a value; none if it is in memory
  std::vector<Group> groups_;
  std::vector<std::uint32_t> readers_;
  std::uint32_t time_ = 0;
  std::size_t alive_ = 0;                                  // results that will be read
  std::uint32_t first_left_ = 0;                           // in the order of the schedule
  std::priority_queue<std::uint64_t> known_;               // those whose operands are known, by their ways to the end
  std::array<std::uint32_t, cycles_ahead> known_later_{};  // by cycles: the first of a list
};

}  // namespace

std::vector<VectorStep> overlapping_order(const std::vector<VectorStep>& steps, std::size_t values,
                                          std::size_t registers) {
  if (steps.size() > most_steps) return steps;
  return ListScheduler(steps, values, registers).order();
}

}  // namespace dmocbench
