#pragma once

#include <string>
#include <vector>

#include "bench/speed/measurements.hpp"

namespace dmocbench::speed {

/// The tables behind a run: times per interval, ratios within the run, and what they are meant to be. What
/// did not run is a dash. A target that is missed is said, and is no failure: the machine may be shared.
[[nodiscard]] std::string summary(const Measurements& measurements, const std::vector<std::string>& problems);

}  // namespace dmocbench::speed
