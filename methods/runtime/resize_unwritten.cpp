#include "methods/runtime/resize_unwritten.hpp"

#include <cstddef>
#include <memory>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace dmocbench {

namespace {

constexpr std::size_t large_page = std::size_t{2} << 20U;

/// A wish: where it cannot be granted, all works as it does without.
void prefer_large_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t page = 4096;
  if (bytes < 2 * large_page || std::align(page, page, begin, bytes) == nullptr) return;
  static_cast<void>(madvise(begin, bytes / page * page, MADV_HUGEPAGE));
#endif
}

}  // namespace

void resize_unwritten(Eigen::VectorXd& vector, Eigen::Index size) {
  if (vector.size() == size) return;
  vector.resize(size);
  prefer_large_pages(vector.data(), static_cast<std::size_t>(size) * sizeof(double));
}

}  // namespace dmocbench
