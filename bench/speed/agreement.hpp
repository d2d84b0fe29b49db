#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/speed/subject.hpp"

namespace dmocbench::speed {

/// The Hessian's entries of one interval, in the order of `IntervalFunctions::hessian`.
using HessianOfInterval = std::function<std::vector<double>(std::size_t interval)>;

/// Throws `Error` unless the entries of every interval are the tape's to 1e-10 of the interval's largest: what is fast
/// and wrong is not timed.
void require_agreement(const Subject& subject, const std::string& name, const HessianOfInterval& hessian);

}  // namespace dmocbench::speed
