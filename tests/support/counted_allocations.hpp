#pragma once

#include <cstddef>

namespace dmocbench::tests {

/// False where malloc is not ours to replace: with other C libraries, and under sanitizers, which have their own.
[[nodiscard]] bool counts_allocations();

/// How often this program has called malloc, calloc, realloc or aligned_alloc: the C functions, because Eigen does not
/// go through operator new. For programs of their own that link `tests_counted_allocations`.
[[nodiscard]] std::size_t allocations();

}  // namespace dmocbench::tests
