#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_set>

#include "methods/expression/expression.hpp"
#include "methods/expression/operation.hpp"

namespace dmocbench::detail {

class NodeTable;

/// The identity of a formula: nodes with equal keys are the same formula.
struct NodeKey {
  Operation operation = Operation::constant;
  double value = 0.0;     // of a constant, or the exponent of a power
  std::size_t index = 0;  // of an input
  std::array<Node*, 2> operands{nullptr, nullptr};

  /// Bitwise on `value`: 0 and -0 are different constants, and NaN equals itself.
  [[nodiscard]] bool equals(const NodeKey& other) const noexcept;
  [[nodiscard]] std::size_t hash() const noexcept;
};

/// One operation of a graph, shared by all formulas that contain it; its readers are counted.
class Node {
 public:
  Node(const NodeKey& key, std::uint64_t serial, NodeTable& table) noexcept
      : key_(key), serial_(serial), table_(&table) {}

  [[nodiscard]] Operation operation() const noexcept { return key_.operation; }
  [[nodiscard]] double value() const noexcept { return key_.value; }
  [[nodiscard]] std::size_t index() const noexcept { return key_.index; }
  [[nodiscard]] Node* operand(std::size_t which) const noexcept { return key_.operands[which]; }
  [[nodiscard]] const NodeKey& key() const noexcept { return key_; }
  void gain_reader() noexcept { ++readers_; }
  /// Returns true if that was the last reader.
  [[nodiscard]] bool lose_reader() noexcept { return --readers_ == 0; }
  /// Order of creation: operands come before the nodes that read them.
  [[nodiscard]] std::uint64_t serial() const noexcept { return serial_; }
  [[nodiscard]] NodeTable& table() const noexcept { return *table_; }

 private:
  NodeKey key_;
  std::uint64_t serial_;
  NodeTable* table_;
  std::size_t readers_ = 0;
};

/// The unique table of one thread: hash-consing makes equal nodes the same node.
///
/// It outlives its thread as long as one of its nodes is alive, so that an expression kept beyond the end of its thread
/// can still be released.
class NodeTable {
 public:
  /// The table of the calling thread.
  [[nodiscard]] static NodeTable& of_this_thread();

  /// The node with this key, which is created if there is none. Throws `Error` if an operand belongs to another
  /// thread's table.
  [[nodiscard]] Node* find_or_create(const NodeKey& key);
  /// Frees a node without readers, and every operand that thereby loses its last reader.
  void erase(Node* node) noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return nodes_.size(); }
  /// To be called when the owning thread ends: the table is destroyed now, or together with its last node.
  void orphan() noexcept;

 private:
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(const NodeKey& key) const noexcept { return key.hash(); }
    std::size_t operator()(const Node* node) const noexcept { return node->key().hash(); }
  };
  struct Equal {
    using is_transparent = void;
    bool operator()(const Node* a, const Node* b) const noexcept { return a == b; }
    bool operator()(const NodeKey& a, const Node* b) const noexcept { return a.equals(b->key()); }
    bool operator()(const Node* a, const NodeKey& b) const noexcept { return b.equals(a->key()); }
  };
  std::unordered_set<Node*, Hash, Equal> nodes_;
  std::uint64_t next_serial_ = 0;
  bool orphaned_ = false;
};

}  // namespace dmocbench::detail
