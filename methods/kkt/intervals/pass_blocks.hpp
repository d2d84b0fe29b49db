#pragma once

#include "methods/kkt/intervals/shape.hpp"

namespace dmocbench::kkt {

// The matrices of one interval of a single pass (single_pass.hpp), for a plain shape with as many sums as unknowns of a
// node. Columns begin at multiples of four numbers, so heights are rounded up.

/// True if a single pass can eliminate intervals of this shape.
constexpr bool fits_single_pass(const auto& shape) {
  return is_plain(shape) && shape.node_sums == shape.node && shape.rows == shape.node && shape.global == 0 &&
         free_size(shape) > 0;
}

constexpr int whole_quads(int rows) { return (rows + 3) / 4 * 4; }
/// Heights of columns with the entries of x, of (x, u), and of X = (x, z).
constexpr int node_height(const auto& shape) { return whole_quads(shape.node); }
constexpr int input_height(const auto& shape) { return whole_quads(shape.node + free_size(shape)); }
constexpr int state_height(const auto& shape) { return whole_quads(2 * shape.node); }

/// An interval's part of the KKT system.
template <class S>
struct PassInputBlocks {
  S shape;
  /// (x, u) x x': the Hessian between them.
  [[nodiscard]] constexpr BlockPlace mixed() const { return {0, input_height(shape), shape.node}; }
  /// (x, u) x (x, u, 1): Hessian and gradient; the part of x comes from inequalities only.
  [[nodiscard]] constexpr BlockPlace form() const {
    return {mixed().end(), input_height(shape), shape.node + free_size(shape) + 1};
  }
  /// x' x (x', 1).
  [[nodiscard]] constexpr BlockPlace next() const { return {form().end(), node_height(shape), shape.node + 1}; }
  /// The equalities' derivatives with respect to x', rows in the order of elimination; then their factors.
  [[nodiscard]] constexpr BlockPlace equality() const { return {next().end(), node_height(shape), shape.node}; }
  /// (x, u) x rows in that order: the equalities' derivatives where D = x' - x takes the place of x'. Then their
  /// values, in the order of the program. Both are negative.
  [[nodiscard]] constexpr BlockPlace inputs() const { return {equality().end(), input_height(shape), shape.node}; }
  [[nodiscard]] constexpr BlockPlace residual() const { return {inputs().end(), node_height(shape), 1}; }
  /// (D, u) x s': the derivatives of -s', in the order of elimination.
  [[nodiscard]] constexpr BlockPlace carry() const { return {residual().end(), input_height(shape), shape.node}; }
  /// (x', (x, u), (value, e)) x inequalities.
  [[nodiscard]] constexpr BlockPlace inequalities() const {
    return {carry().end(), node_height(shape) + input_height(shape) + 4, shape.inequalities};
  }
  [[nodiscard]] constexpr int size() const { return inequalities().end(); }
};

/// What the forward pass needs of an interval.
template <class S>
struct PassRecordBlocks {
  S shape;
  /// (x, u) x D, and D: the increment D = x' - x is (increment)ᵀ (x, u) + z + (constant).
  [[nodiscard]] constexpr BlockPlace increment() const { return {0, input_height(shape), shape.node}; }
  [[nodiscard]] constexpr BlockPlace constant() const { return {increment().end(), node_height(shape), 1}; }
  /// (D, u) x z': z' = (sums)ᵀ (D, u).
  [[nodiscard]] constexpr BlockPlace sums() const { return {constant().end(), input_height(shape), shape.node}; }
  /// s x z: z = -(inverse)ᵀ s.
  [[nodiscard]] constexpr BlockPlace inverse() const { return {sums().end(), node_height(shape), shape.node}; }
  /// (X) x u and u: Lᵀ u = -(gain)ᵀ X - (offset).
  [[nodiscard]] constexpr BlockPlace gain() const { return {inverse().end(), state_height(shape), free_size(shape)}; }
  [[nodiscard]] constexpr BlockPlace offset() const { return {gain().end(), whole_quads(free_size(shape)), 1}; }
  /// u x u: L, whose diagonal is 1.
  [[nodiscard]] constexpr BlockPlace factor() const {
    return {offset().end(), whole_quads(free_size(shape)), free_size(shape)};
  }
  /// X x z and z: the derivative of the cost-to-go with respect to z.
  [[nodiscard]] constexpr BlockPlace costate() const { return {factor().end(), state_height(shape), shape.node}; }
  [[nodiscard]] constexpr BlockPlace costate_offset() const { return {costate().end(), node_height(shape), 1}; }
  [[nodiscard]] constexpr int size() const { return costate_offset().end(); }
};

/// The terms of ν, for the intervals that carry it: `offset` and `costate_offset` of every entry of ν.
template <class S>
struct PassEndBlocks {
  S shape;
  [[nodiscard]] constexpr BlockPlace offset() const { return {0, whole_quads(free_size(shape)), 2 * shape.node}; }
  [[nodiscard]] constexpr BlockPlace costate_offset() const {
    return {offset().end(), node_height(shape), 2 * shape.node};
  }
  [[nodiscard]] constexpr int size() const { return costate_offset().end(); }
};

/// The cost-to-go.
template <class S>
struct PassValueBlocks {
  S shape;
  /// X x X: P, lower and upper triangle; then X x (1, ν): p, Φ.
  [[nodiscard]] constexpr BlockPlace hessian() const { return {0, state_height(shape), state_height(shape)}; }
  [[nodiscard]] constexpr BlockPlace extras() const {
    return {hessian().end(), state_height(shape), 1 + 2 * shape.node};
  }
  /// ν x (1, ν): γ - d, Γ.
  [[nodiscard]] constexpr BlockPlace reachability() const {
    return {extras().end(), 2 * shape.node, 1 + 2 * shape.node};
  }
  [[nodiscard]] constexpr int size() const { return reachability().end(); }
};

/// Work of one step forward; also its results.
template <class S>
struct PassForwardBlocks {
  S shape;
  [[nodiscard]] constexpr BlockPlace state() const { return {0, state_height(shape), 1}; }  ///< X
  [[nodiscard]] constexpr BlockPlace inputs() const {                                       ///< (x, u), then (D, u)
    return {state().end(), input_height(shape), 1};
  }
  [[nodiscard]] constexpr BlockPlace costate() const { return {inputs().end(), node_height(shape), 1}; }  ///< of z
  [[nodiscard]] constexpr BlockPlace multipliers() const { return {costate().end(), node_height(shape), 1}; }
  [[nodiscard]] constexpr int size() const { return multipliers().end(); }
};

}  // namespace dmocbench::kkt
