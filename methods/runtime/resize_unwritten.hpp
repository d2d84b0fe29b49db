#pragma once

#include <Eigen/Core>

namespace dmocbench {

/// Resizes to `size` entries, which may have any value then. A vector of several MiB asks the system for large pages,
/// which are given to whatever is written first: to hand out and to clear pages of 4 KiB takes longer than a pass over
/// what is in them (0.37 against 0.03 s per GiB, measured; 0.05 s with large ones).
void resize_unwritten(Eigen::VectorXd& vector, Eigen::Index size);

}  // namespace dmocbench
