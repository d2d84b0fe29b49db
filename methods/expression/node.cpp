#include "methods/expression/node.hpp"

#include <bit>
#include <functional>
#include <vector>

#include "methods/error.hpp"

namespace dmocbench::detail {

bool NodeKey::equals(const NodeKey& other) const noexcept {
  return operation == other.operation && index == other.index && operands == other.operands &&
         std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(other.value);
}

std::size_t NodeKey::hash() const noexcept {
  auto hash = static_cast<std::uint64_t>(operation);
  const auto mix = [&hash](std::uint64_t word) {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15ULL;  // golden-ratio multiplier (Knuth)
    hash ^= hash >> 32U;
  };
  mix(std::bit_cast<std::uint64_t>(value));
  mix(index);
  mix(std::bit_cast<std::uint64_t>(operands[0]));
  mix(std::bit_cast<std::uint64_t>(operands[1]));
  return hash;
}

void retain(Node* node) noexcept {
  if (node != nullptr) node->gain_reader();
}

void release(Node* node) noexcept {
  if (node != nullptr && node->lose_reader()) node->table().erase(node);
}

NodeTable& NodeTable::of_this_thread() {
  struct Owner {
    NodeTable* table = new NodeTable;
    Owner() = default;
    Owner(const Owner&) = delete;
    Owner& operator=(const Owner&) = delete;
    Owner(Owner&&) = delete;
    Owner& operator=(Owner&&) = delete;
    ~Owner() { table->orphan(); }
  };
  thread_local const Owner owner;
  return *owner.table;
}

Node* NodeTable::find_or_create(const NodeKey& key) {
  for (Node* operand : key.operands) {
    if (operand != nullptr && &operand->table() != this) {
      throw Error("expressions of two threads meet in one formula; trace each formula in one thread");
    }
  }
  if (const auto found = nodes_.find(key); found != nodes_.end()) return *found;
  auto* node = new Node(key, next_serial_++, *this);
  nodes_.insert(node);
  for (Node* operand : key.operands) retain(operand);
  return node;
}

void NodeTable::erase(Node* node) noexcept {
  // A loop, not recursion: a chain of a million operations must not overflow the stack.
  std::vector<Node*> doomed{node};
  while (!doomed.empty()) {
    Node* last = doomed.back();
    doomed.pop_back();
    nodes_.erase(last);
    for (Node* operand : last->key().operands) {
      if (operand != nullptr && operand->lose_reader()) doomed.push_back(operand);
    }
    delete last;
  }
  if (orphaned_ && nodes_.empty()) delete this;
}

void NodeTable::orphan() noexcept {
  orphaned_ = true;
  if (nodes_.empty()) delete this;
}

}  // namespace dmocbench::detail

namespace dmocbench {

std::size_t live_nodes() noexcept { return detail::NodeTable::of_this_thread().size(); }

}  // namespace dmocbench
