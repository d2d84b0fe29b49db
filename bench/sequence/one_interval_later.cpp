#include "bench/sequence/shifted.hpp"

namespace dmocbench {

Eigen::VectorXd shifted(const Places& places, const Eigen::VectorXd& values) {
  Eigen::VectorXd result = values;
  for (const PlaceRun& run : places.runs()) {
    if (run.kind == Place::Kind::border || run.count < 2) continue;
    const auto first = static_cast<Eigen::Index>(run.first);
    const auto moved = static_cast<Eigen::Index>(run.count) - 1;
    result.segment(first, moved) = values.segment(first + 1, moved);
  }
  return result;
}

}  // namespace dmocbench
