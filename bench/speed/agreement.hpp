#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/speed/subject.hpp"

namespace dmocbench::speed {

/// The outputs of a schedule on one interval, in its order.
using ValuesOfInterval = std::function<std::vector<double>(std::size_t interval)>;

/// Throws `Error` unless the values of every interval are the tape's to `tolerance` times the interval's largest: what
/// is fast and wrong is not timed.
void require_agreement(const Subject& subject, const Schedule& schedule, const std::string& name,
                       const ValuesOfInterval& values, double tolerance = 1e-10);

}  // namespace dmocbench::speed
