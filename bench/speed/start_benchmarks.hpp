#pragma once

#include <span>
#include <string>
#include <vector>

namespace dmocbench::speed {

/// Hands Google Benchmark its flags: those of this suite (five repetitions, in random order so that a disturbance of a
/// shared machine is spread over all benchmarks), then `ours`, then the user's, which win. False if there is a flag
/// that nobody knows.
[[nodiscard]] bool initialize(const char* program, std::span<char* const> flags,
                              const std::vector<std::string>& ours = {});

}  // namespace dmocbench::speed
