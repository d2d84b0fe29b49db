#include "methods/program/large_pages.hpp"

#include <cstddef>
#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace dmocbench {

namespace {

constexpr std::size_t large_page = std::size_t{2} << 20U;

/// A wish: where it cannot be granted, all works as it does without.
void prefer_large_pages([[maybe_unused]] double* begin, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  if (bytes < 2 * large_page) return;
  constexpr std::uintptr_t page = 4096;
  const auto first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page;
  const auto end = (reinterpret_cast<std::uintptr_t>(begin) + bytes) / page * page;
  static_cast<void>(madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE));
#endif
}

}  // namespace

void resize_unwritten(Eigen::VectorXd& vector, Eigen::Index size) {
  if (vector.size() == size) return;
  vector.resize(size);
  prefer_large_pages(vector.data(), static_cast<std::size_t>(size) * sizeof(double));
}

}  // namespace dmocbench
