#pragma once

#include <cmath>
#include <random>

namespace dmocbench {

/// Evenly distributed in [0, 1). Unlike std::uniform_real_distribution, it gives the same numbers with every standard
/// library.
inline double uniform_01(std::mt19937_64& engine) { return std::ldexp(static_cast<double>(engine() >> 11U), -53); }
/// The same by a generator of 32 bits.
inline double uniform_01(std::mt19937& engine) { return std::ldexp(static_cast<double>(engine()), -32); }

}  // namespace dmocbench
