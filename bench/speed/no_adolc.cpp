// Stands in for adolc_benchmarks.cpp where ADOL-C is not installed.
#include "bench/speed/benchmarks.hpp"

namespace dmocbench::speed {

void register_adolc_benchmarks(const Subjects& /*subjects*/) {}

}  // namespace dmocbench::speed
