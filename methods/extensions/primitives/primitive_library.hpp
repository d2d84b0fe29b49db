#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "methods/extensions/primitives/symmetry_group.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// A short motion from one state of a library to another one modulo the symmetry: an optimum of DMOC by the midpoint
/// rule. Moved by an element of the group it is as good a motion, with the same cost.
struct Primitive {
  std::size_t first = 0;      ///< it begins in `PrimitiveLibrary::states[first]`
  std::size_t last = 0;       ///< and ends in `states[last]`, moved by `displacement`
  Displacement displacement;  ///< the identity where there is no symmetry
  int duration = 1;           ///< in time steps of the library
  double cost = 0.0;          ///< ∫ C dt by the midpoint rule, the true cost
  Eigen::MatrixXd q;          ///< at the nodes, (K + 1) × n with K = duration · intervals_per_step
  Eigen::MatrixXd v;          ///< at the nodes, (K + 1) × n, with p = L_v(q, v)
  Eigen::MatrixXd u;          ///< in the intervals, K × m
};

/// Primitives of one problem with one time step. The problem must neither depend on time nor have a final cost.
struct PrimitiveLibrary {
  std::string problem;                                          ///< its name
  std::vector<std::pair<std::string, double>> parameters = {};  ///< all of them
  double step = 0.0;                       ///< length of a time step, in the problem's unit of time
  int intervals_per_step = 1;              ///< intervals of the midpoint rule in each
  std::vector<BoundaryState> states = {};  ///< of trims, or of a lattice
  /// All of them, in the order in which they were found.
  std::vector<Primitive> primitives = {};

  /// An empty library.
  [[nodiscard]] static PrimitiveLibrary of(const Problem& problem, double step, int intervals_per_step);
  /// Throws `Error` in one sentence unless it was made for that problem with those parameters, all sizes fit, every
  /// primitive has the cost of its motion, and a horizon has at most a million steps.
  void require_made_for(const Problem& asked) const;
};

}  // namespace dmocbench
