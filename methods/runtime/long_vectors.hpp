#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "methods/runtime/parallel.hpp"
#include "methods/runtime/vector_loops.hpp"

namespace dmocbench {

/// Entries of a vector that are worth a thread of their own.
inline constexpr std::size_t entries_per_stretch = 65536;

/// Calls `use(stretch, begin, length)` for stretches that cover 0 to size - 1, stretches of a long vector by several
/// threads. How many there are depends on the size alone.
template <class Use>
void for_stretches(Eigen::Index size, const Use& use) {
  const auto count = static_cast<std::size_t>(size);
  const std::size_t stretches = part_count(count, entries_per_stretch);
  if (stretches == 1) return use(std::size_t{0}, Eigen::Index{0}, size);
  for_each_part(stretches, [&](std::size_t s) {
    const auto begin = static_cast<Eigen::Index>(begin_of_part(s, stretches, count));
    const auto end = static_cast<Eigen::Index>(begin_of_part(s + 1, stretches, count));
    use(s, begin, end - begin);
  });
}

/// The sum of `part(begin, length)` over all stretches of a vector of `size` entries. The terms are added in the order
/// of the stretches, so that the result does not depend on the number of threads.
template <class Part>
double sum_of_stretches(Eigen::Index size, const Part& part) {
  if (part_count(static_cast<std::size_t>(size), entries_per_stretch) == 1) return part(Eigen::Index{0}, size);
  std::array<double, most_parts> sums{};
  for_stretches(size, [&](std::size_t s, Eigen::Index begin, Eigen::Index length) { sums[s] = part(begin, length); });
  double sum = 0.0;
  for (const double term : sums) sum += term;
  return sum;
}

/// The largest magnitude of an entry; 0 for an empty vector. The result is arbitrary if an entry is not finite.
[[nodiscard]] double largest_of(const Eigen::VectorXd& vector);
/// Σ |x_i|.
[[nodiscard]] double sum_of_magnitudes(const Eigen::VectorXd& vector);
/// True if every entry is finite.
[[nodiscard]] bool is_finite(const Eigen::VectorXd& vector);
/// aᵀb, for vectors of the same size.
[[nodiscard]] double dot_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// Resizes to `size` entries of any value. A vector of several MiB requests large pages from the system, which it gets
/// as they are written first: to provide and to clear pages of 4 KiB takes longer than a pass over their contents.
void resize_unwritten(Eigen::VectorXd& vector, Eigen::Index size);
/// target = vector + factor * step
void set_to_sum(Eigen::VectorXd& target, const Eigen::VectorXd& vector, double factor, const Eigen::VectorXd& step);
/// target = vector
void copy_to(Eigen::VectorXd& target, const Eigen::VectorXd& vector);
/// Resizes to `size` zeros.
void set_zero(Eigen::VectorXd& target, Eigen::Index size);

}  // namespace dmocbench
