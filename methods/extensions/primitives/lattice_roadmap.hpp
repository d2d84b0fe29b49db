#pragma once

#include "methods/extensions/primitives/meeting_trees.hpp"
#include "methods/extensions/primitives/solve_primitives.hpp"
#include "methods/extensions/primitives/stored_roadmap.hpp"
#include "methods/mechanics/forwarding_problem.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A problem without its bounds on q, q̇ and u along the motion; everything else is unchanged.
class WithoutBounds final : public ForwardingProblem {
 public:
  /// The problem must outlive it.
  explicit WithoutBounds(const Problem& base) : ForwardingProblem(base) {}

  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = original().bounds();
    bounds.q = {};
    bounds.v = {};
    bounds.u = {};
    return bounds;
  }
};

/// A roadmap between the ends of a problem whose states lie on a lattice, one in a cell at most.
///
/// Two trees of motions under constant controls (`grow_tree`), one forwards from the first state and one backwards
/// from the last, give the cells that motions of little cost visit: where there are fewer controls than velocities, few
/// of all states are within reach of each other. Their last layers are a connection apart. Those pairs are joined that
/// take the least cost in all, first by the linearised estimate (`Steering`), then by the result of some Newton steps
/// of shooting. These connections, and the branches that lead to them, are solved by DMOC (`solve_primitives`); the
/// edges are the solved ones.
///
/// Primitives keep the problem's bounds on q at the states, but none in between, and none on velocities and controls:
/// the solve that starts from a path has to impose them. Throws `Error` as `solve_primitives` does, and if sizes do not
/// fit the problem.
[[nodiscard]] StoredRoadmap lattice_roadmap(const Problem& problem, const LatticeOptions& options,
                                            const PrimitiveOptions& primitive_options = {});

}  // namespace dmocbench
