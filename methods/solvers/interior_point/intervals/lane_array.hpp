#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace dmocbench::interior_point {

/// Numbers on a boundary of 64 bytes, as vector registers want them.
class LaneArray {
 public:
  /// Makes room for at least `count` numbers, all zero.
  void resize(std::size_t count) { lines_.assign(count / line_size + 1, Line{}); }

  [[nodiscard]] double* data() noexcept { return lines_.front().numbers.data(); }

 private:
  static constexpr std::size_t line_size = 8;
  struct alignas(line_size * sizeof(double)) Line {
    std::array<double, line_size> numbers{};
  };
  std::vector<Line> lines_ = std::vector<Line>(1);
};

}  // namespace dmocbench::interior_point
