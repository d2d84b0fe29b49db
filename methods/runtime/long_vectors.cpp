#include "methods/runtime/long_vectors.hpp"

#include <algorithm>
#include <memory>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace dmocbench {

const VectorLoops& vector_loops_of(InstructionSet set) {
  static constexpr std::array loops{DMOCBENCH_VERSIONS(&vector_loops)};
  return *compiled_for(set, loops);
}

const VectorLoops& vector_loops() {
  static const VectorLoops& preferred = vector_loops_of(preferred_instruction_set());
  return preferred;
}

double largest_of(const Eigen::VectorXd& vector) {
  if (part_count(static_cast<std::size_t>(vector.size()), entries_per_stretch) == 1) {
    return vector_loops().largest(vector.data(), vector.size());
  }
  std::array<double, most_parts> largest{};
  for_stretches(vector.size(), [&](std::size_t s, Eigen::Index begin, Eigen::Index length) {
    largest[s] = vector_loops().largest(vector.data() + begin, length);
  });
  return *std::ranges::max_element(largest);
}

double sum_of_magnitudes(const Eigen::VectorXd& vector) {
  return sum_of_stretches(vector.size(), [&](Eigen::Index begin, Eigen::Index length) {
    return vector_loops().sum_of_magnitudes(vector.data() + begin, length);
  });
}

bool is_finite(const Eigen::VectorXd& vector) {  // Eigen's allFinite() looks at one number at a time
  return sum_of_stretches(vector.size(), [&](Eigen::Index begin, Eigen::Index length) {
           return vector_loops().sum_of_zeros(vector.data() + begin, length);
         }) == 0.0;
}

double dot_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return sum_of_stretches(a.size(), [&](Eigen::Index begin, Eigen::Index length) {
    return vector_loops().dot(a.data() + begin, b.data() + begin, length);
  });
}

void resize_unwritten(Eigen::VectorXd& vector, Eigen::Index size) {
  if (vector.size() == size) return;
  vector.resize(size);
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t page = 4096;
  constexpr std::size_t large_page = std::size_t{2} << 20U;
  void* begin = vector.data();
  std::size_t bytes = static_cast<std::size_t>(size) * sizeof(double);
  if (bytes < 2 * large_page || std::align(page, page, begin, bytes) == nullptr) return;
  static_cast<void>(madvise(begin, bytes / page * page, MADV_HUGEPAGE));  // where it fails, pages stay small
#endif
}

void set_to_sum(Eigen::VectorXd& target, const Eigen::VectorXd& vector, double factor, const Eigen::VectorXd& step) {
  resize_unwritten(target, vector.size());
  for_stretches(vector.size(), [&](std::size_t, Eigen::Index begin, Eigen::Index length) {
    vector_loops().set_to_sum(target.data() + begin, vector.data() + begin, factor, step.data() + begin, length);
  });
}

void copy_to(Eigen::VectorXd& target, const Eigen::VectorXd& vector) {
  resize_unwritten(target, vector.size());
  for_stretches(vector.size(), [&](std::size_t, Eigen::Index begin, Eigen::Index length) {
    target.segment(begin, length) = vector.segment(begin, length);
  });
}

void set_zero(Eigen::VectorXd& target, Eigen::Index size) {
  resize_unwritten(target, size);
  for_stretches(size,
                [&](std::size_t, Eigen::Index begin, Eigen::Index length) { target.segment(begin, length).setZero(); });
}

}  // namespace dmocbench
