#pragma once

#include <string>

#include "bench/experiment/table.hpp"
#include "bench/speed/measurements.hpp"

namespace dmocbench::speed {

/// A row per benchmark per interval: what was timed, the work of an interval, its time, and the roof of that work. A
/// roof stands where arrays are counted and the benchmarks of the machine ran on the same instruction set.
[[nodiscard]] Table interval_table(const Measurements& measurements);

/// A row per instruction set and limit ("arithmetic" or a level of memory): `rate` in operations or bytes per second.
[[nodiscard]] Table machine_table(const Measurements& measurements);

/// The rows of `interval_table` that have a roof, as text.
[[nodiscard]] std::string roofline(const Table& intervals);

}  // namespace dmocbench::speed
