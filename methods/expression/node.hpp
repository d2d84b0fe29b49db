#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "methods/expression/operation.hpp"

namespace dmocbench {
class Expression;
}

namespace dmocbench::detail {

class Node;
class NodeTable;

/// The identity of a formula: nodes with equal keys are the same formula.
struct NodeKey {
  Operation operation = Operation::constant;        ///< how it is computed
  double value = 0.0;                               ///< of a constant, or the exponent of a power
  std::size_t index = 0;                            ///< of an input
  std::array<Node*, 2> operands{nullptr, nullptr};  ///< null where the operation has fewer

  /// Bitwise on `value`: 0 and -0 are different constants, and NaN equals itself.
  [[nodiscard]] bool equals(const NodeKey& other) const noexcept;
  /// Equal for equal keys.
  [[nodiscard]] std::size_t hash() const noexcept;
};

/// One operation of a graph, shared by all formulas that contain it; its readers are counted.
class Node {
 public:
  /// A node of this key in the table of its thread.
  Node(const NodeKey& key, NodeTable& table) noexcept : key_(key), table_(&table) {}

  /// The operation that computes it.
  [[nodiscard]] Operation operation() const noexcept { return key_.operation; }
  /// The value of a constant, or the exponent of a power.
  [[nodiscard]] double value() const noexcept { return key_.value; }
  /// The number of an input.
  [[nodiscard]] std::size_t index() const noexcept { return key_.index; }
  /// Null where the operation has fewer.
  [[nodiscard]] Node* operand(std::size_t which) const noexcept { return key_.operands[which]; }
  /// Its identity: no other node has this key.
  [[nodiscard]] const NodeKey& key() const noexcept { return key_; }
  /// Order of creation: operands come before the nodes that read them.
  [[nodiscard]] std::uint64_t serial() const noexcept { return serial_; }
  /// The place that `reachable_nodes` gave this node, or an algorithm after it.
  [[nodiscard]] std::uint32_t number() const noexcept { return number_; }
  /// Gives it a number within a walk over the graph.
  void set_number(std::size_t number) noexcept { number_ = static_cast<std::uint32_t>(number); }
  /// One more node or expression reads it.
  void gain_reader() noexcept { ++readers_; }
  /// The last reader frees the node.
  void lose_reader() noexcept {
    if (--readers_ == 0) free();
  }

 private:
  friend class NodeTable;
  friend std::vector<Node*> reachable_nodes(std::span<const Expression> formulas);
  void free() noexcept;

  NodeKey key_;
  std::uint64_t serial_ = 0;
  NodeTable* table_;
  Node* next_ = nullptr;  // in the table's chain, or among the nodes to be freed or reused
  std::uint64_t traversal_ = 0;
  std::uint32_t number_ = 0;
  std::uint32_t readers_ = 0;
};

/// The unique table of one thread: hash-consing makes equal nodes the same node.
///
/// It outlives its thread as long as one of its nodes is alive, so that an expression kept beyond the end of its thread
/// can still be released. Memory of freed nodes is used again.
class NodeTable {
 public:
  /// The table of the calling thread.
  [[nodiscard]] static NodeTable& of_this_thread();

  /// The node with this key, which is created if there is none. Throws `Error` if an operand belongs to another
  /// thread's table; throws `Stopped` where a `StopScope` of the thread requires it.
  [[nodiscard]] Node* find_or_create(const NodeKey& key);
  /// The constant 0, which stays, because every new `Expression` and empty vector reads it.
  [[nodiscard]] Node* zero() const noexcept { return zero_; }
  /// The number of nodes apart from `zero`.
  [[nodiscard]] std::size_t size() const noexcept { return size_ - 1; }

 private:
  friend class Node;

  NodeTable();
  /// The thread has ended: the table is destroyed now, or together with its last node.
  void orphan() noexcept;
  /// Frees a node without readers, and every operand that thereby loses its last reader.
  void erase(Node* node) noexcept;
  /// The head of the chain in which a node with this key stands.
  [[nodiscard]] Node*& chain_of(const NodeKey& key) noexcept { return chains_[key.hash() & (chains_.size() - 1)]; }
  void lengthen();

  std::vector<Node*> chains_;  // as many as a power of two
  std::deque<Node> memory_;
  Node* unused_ = nullptr;  // freed nodes
  std::size_t size_ = 0;
  std::uint64_t next_serial_ = 0;
  bool orphaned_ = false;
  Node* zero_;
};

}  // namespace dmocbench::detail
