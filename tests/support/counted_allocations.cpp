#include "tests/support/counted_allocations.hpp"

#include <atomic>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define DMOCBENCH_COUNTS_ALLOCATIONS 1
#else
#define DMOCBENCH_COUNTS_ALLOCATIONS 0
#endif

namespace {
std::atomic<std::size_t> calls{0};
}  // namespace

#if DMOCBENCH_COUNTS_ALLOCATIONS
extern "C" void* __libc_malloc(std::size_t size);                           // NOLINT
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT
extern "C" void* __libc_realloc(void* memory, std::size_t size);            // NOLINT
extern "C" void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT
extern "C" void* malloc(std::size_t size) noexcept {
  ++calls;
  return __libc_malloc(size);
}
extern "C" void* calloc(std::size_t count, std::size_t size) noexcept {
  ++calls;
  return __libc_calloc(count, size);
}
extern "C" void* realloc(void* memory, std::size_t size) noexcept {
  ++calls;
  return __libc_realloc(memory, size);
}
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++calls;
  return __libc_memalign(alignment, size);
}
#endif

namespace dmocbench::tests {

bool counts_allocations() { return DMOCBENCH_COUNTS_ALLOCATIONS != 0; }

std::size_t allocations() { return calls; }

}  // namespace dmocbench::tests
