#pragma once

#include <cstdint>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/interpolation.hpp"

namespace dmocbench {

/// A motion with smooth random curves added: to every q_i a sum of three sines that vanish at both ends, their
/// amplitudes drawn evenly between -a and a times the range of that q_i along the motion (1 where it has none) and
/// falling as 1/k, with their derivatives added to the velocity. The control stays. The same `seed` and `number` give
/// the same curves on every machine; number 0 is the motion itself.
[[nodiscard]] Motion perturbed(const Motion& motion, double amplitude, std::uint64_t seed, std::uint64_t number);

}  // namespace dmocbench
