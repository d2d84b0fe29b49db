#pragma once

#include <Eigen/Core>

#include "methods/program/interval_structure.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The motion of a horizon that has moved on by the first interval of its grid: q(t + h), carried on beyond its end by
/// the velocity that it has there.
[[nodiscard]] Motion one_interval_later(const Trajectory& trajectory);

/// Multipliers of a problem that has moved on by one interval of a uniform grid: values of node or interval k + 1 move
/// to k. The last node and interval keep their values, as do places at one end and of the whole horizon. `values` has
/// an entry per place.
[[nodiscard]] Eigen::VectorXd shifted(const Places& places, const Eigen::VectorXd& values);

}  // namespace dmocbench
