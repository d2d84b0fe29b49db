#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "methods/runtime/parallel.hpp"
#include "methods/runtime/resize_unwritten.hpp"
#include "methods/runtime/vector_loops.hpp"

namespace dmocbench {

/// Entries of a vector that are worth a thread of their own.
inline constexpr std::size_t entries_per_stretch = 65536;

/// Calls `use(stretch, begin, length)` for stretches that cover 0 .. size - 1, those of a long vector by several
/// threads. How many there are depends on the size alone.
template <class Use>
void for_stretches(Eigen::Index size, const Use& use) {
  const auto count = static_cast<std::size_t>(size);
  const std::size_t stretches = part_count(count, entries_per_stretch);
  for_each_part(stretches, [&](std::size_t s) {
    const auto begin = static_cast<Eigen::Index>(begin_of_part(s, stretches, count));
    const auto end = static_cast<Eigen::Index>(begin_of_part(s + 1, stretches, count));
    use(s, begin, end - begin);
  });
}

/// The sum, in order, of what `part(begin, length)` is on stretches.
template <class Part>
double sum_of_stretches(Eigen::Index size, const Part& part) {
  std::array<double, most_parts> sums{};
  for_stretches(size, [&](std::size_t s, Eigen::Index begin, Eigen::Index length) { sums[s] = part(begin, length); });
  double sum = 0.0;
  for (const double term : sums) sum += term;
  return sum;
}

/// Largest magnitude, 0 of an empty vector; of no use where a number is not finite.
inline double largest_of(const Eigen::VectorXd& vector) {
  std::array<double, most_parts> largest{};
  for_stretches(vector.size(), [&](std::size_t s, Eigen::Index begin, Eigen::Index length) {
    largest[s] = vector_loops().largest(vector.data() + begin, length);
  });
  return *std::max_element(largest.begin(), largest.end());
}

inline double sum_of_magnitudes(const Eigen::VectorXd& vector) {
  return sum_of_stretches(vector.size(), [&](Eigen::Index begin, Eigen::Index length) {
    return vector_loops().sum_of_magnitudes(vector.data() + begin, length);
  });
}

/// Eigen's allFinite() looks at one number at a time.
inline bool is_finite(const Eigen::VectorXd& vector) {
  return sum_of_stretches(vector.size(), [&](Eigen::Index begin, Eigen::Index length) {
           return vector_loops().sum_of_zeros(vector.data() + begin, length);
         }) == 0.0;
}

inline double dot_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return sum_of_stretches(a.size(), [&](Eigen::Index begin, Eigen::Index length) {
    return vector_loops().dot(a.data() + begin, b.data() + begin, length);
  });
}

/// target = vector + factor * step
inline void set_to_sum(Eigen::VectorXd& target, const Eigen::VectorXd& vector, double factor,
                       const Eigen::VectorXd& step) {
  resize_unwritten(target, vector.size());
  for_stretches(vector.size(), [&](std::size_t, Eigen::Index begin, Eigen::Index length) {
    vector_loops().set_to_sum(target.data() + begin, vector.data() + begin, factor, step.data() + begin, length);
  });
}

/// target = vector
inline void copy_to(Eigen::VectorXd& target, const Eigen::VectorXd& vector) {
  resize_unwritten(target, vector.size());
  for_stretches(vector.size(), [&](std::size_t, Eigen::Index begin, Eigen::Index length) {
    target.segment(begin, length) = vector.segment(begin, length);
  });
}

/// Resizes to `size` zeros.
inline void set_zero(Eigen::VectorXd& target, Eigen::Index size) {
  resize_unwritten(target, size);
  for_stretches(size,
                [&](std::size_t, Eigen::Index begin, Eigen::Index length) { target.segment(begin, length).setZero(); });
}

}  // namespace dmocbench
