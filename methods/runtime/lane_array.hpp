#pragma once

#include <array>
#include <cstddef>
#include <memory>

namespace dmocbench::interior_point {

/// Numbers on a boundary of 64 bytes, as vector registers want them.
class LaneArray {
 public:
  /// Makes room for at least `count` numbers. They are anything: memory is first touched by the thread that fills it.
  void resize(std::size_t count) { lines_ = std::make_unique_for_overwrite<Lines>(count / line_size + 1); }

  [[nodiscard]] double* data() noexcept { return lines_ ? lines_[0].numbers.data() : nullptr; }

 private:
  static constexpr std::size_t line_size = 8;
  struct alignas(line_size * sizeof(double)) Line {
    std::array<double, line_size> numbers;
  };
  // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): a vector would write zeros
  using Lines = Line[];
  std::unique_ptr<Lines> lines_;
};

}  // namespace dmocbench::interior_point
