#pragma once

#include <vector>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::interior_point {

/// An order of elimination for the KKT matrix of a program with an interval structure, by nested dissection: the node
/// in the middle of the horizon comes last, before it the nodes in the middle of either half, and so on down to some
/// intervals, which are eliminated one after the other. What has to wait for a better pivot then waits for a few nodes
/// only, not for the rest of the horizon.
///
/// The position of every line, unknowns first, then rows; empty if the program tells no interval structure.
[[nodiscard]] std::vector<int> dissection_order(const NonlinearProgram& program);

}  // namespace dmocbench::interior_point
