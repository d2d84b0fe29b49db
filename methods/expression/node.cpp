#include "methods/expression/node.hpp"

#include <bit>
#include <memory>

#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench::detail {

bool NodeKey::equals(const NodeKey& other) const noexcept {
  return operation == other.operation && index == other.index && operands == other.operands &&
         std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(other.value);
}

std::size_t NodeKey::hash() const noexcept {
  // Three products that do not wait for each other; the multipliers are odd and have no pattern.
  const std::uint64_t number = std::bit_cast<std::uint64_t>(value) + 32 * index + static_cast<std::uint64_t>(operation);
  const std::uint64_t hash = number * 0x9e3779b97f4a7c15ULL ^
                             std::bit_cast<std::uint64_t>(operands[0]) * 0xbf58476d1ce4e5b9ULL ^
                             std::bit_cast<std::uint64_t>(operands[1]) * 0x94d049bb133111ebULL;
  return hash >> 32U;
}

void Node::free() noexcept { table_->erase(this); }

NodeTable& NodeTable::of_this_thread() {
  constexpr auto orphan = [](NodeTable* table) noexcept { table->orphan(); };
  thread_local const std::unique_ptr<NodeTable, decltype(orphan)> table(new NodeTable, orphan);
  return *table;
}

NodeTable::NodeTable() : chains_(1024), zero_(find_or_create({})) { zero_->gain_reader(); }

Node* NodeTable::find_or_create(const NodeKey& key) {
  for (Node* operand : key.operands) {
    if (operand != nullptr && operand->table_ != this) {
      throw Error("a formula contains expressions from two threads; trace each formula in one thread");
    }
  }
  for (Node* node = chain_of(key); node != nullptr; node = node->next_) {
    if (node->key_.equals(key)) return node;
  }
  constexpr std::uint64_t nodes_between_questions = 4096;  // a fraction of a millisecond
  if (next_serial_ % nodes_between_questions == nodes_between_questions - 1) stop_if_requested();
  if (size_ == chains_.size()) lengthen();
  Node* node = unused_;
  if (node == nullptr) {
    node = &memory_.emplace_back(key, *this);
  } else {
    unused_ = node->next_;
    node->key_ = key;
  }
  node->serial_ = next_serial_++;
  Node*& head = chain_of(key);
  node->next_ = head;
  head = node;
  ++size_;
  for (Node* operand : key.operands) {
    if (operand != nullptr) operand->gain_reader();
  }
  return node;
}

void NodeTable::lengthen() {
  std::vector<Node*> nodes;
  for (Node* node : chains_) {
    for (; node != nullptr; node = node->next_) nodes.push_back(node);
  }
  chains_.assign(2 * chains_.size(), nullptr);
  for (Node* node : nodes) {
    Node*& head = chain_of(node->key_);
    node->next_ = head;
    head = node;
  }
}

void NodeTable::erase(Node* node) noexcept {
  // A loop, not recursion: a chain of a million operations must not overflow the stack.
  Node* doomed = nullptr;
  const auto doom = [&](Node* last) {
    Node** link = &chain_of(last->key_);
    while (*link != last) link = &(*link)->next_;
    *link = last->next_;
    last->next_ = doomed;
    doomed = last;
  };
  doom(node);
  while (doomed != nullptr) {
    Node* last = doomed;
    doomed = last->next_;
    for (Node* operand : last->key_.operands) {
      if (operand != nullptr && --operand->readers_ == 0) doom(operand);
    }
    last->next_ = unused_;
    unused_ = last;
    --size_;
  }
  if (orphaned_ && size_ == 0) delete this;
}

void NodeTable::orphan() noexcept {
  orphaned_ = true;
  zero_->lose_reader();
}

}  // namespace dmocbench::detail

namespace dmocbench {

std::size_t live_nodes() noexcept { return detail::NodeTable::of_this_thread().size(); }

}  // namespace dmocbench
