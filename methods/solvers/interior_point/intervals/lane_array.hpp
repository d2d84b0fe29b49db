#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

namespace dmocbench::interior_point {

/// Numbers on a boundary of 64 bytes, as vector registers want them; not initialised.
class LaneArray {
 public:
  LaneArray() = default;

  /// Makes room for `count` numbers; what was there is lost.
  void resize(std::size_t count) {
    constexpr std::size_t line = 64;
    const std::size_t bytes = (count * sizeof(double) + line - 1) / line * line;
    numbers_.reset(static_cast<double*>(std::aligned_alloc(line, bytes)));
    if (bytes > 0 && numbers_ == nullptr) throw std::bad_alloc();
    size_ = count;
  }

  [[nodiscard]] double* data() noexcept { return numbers_.get(); }
  [[nodiscard]] const double* data() const noexcept { return numbers_.get(); }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  struct Free {
    void operator()(double* numbers) const noexcept { std::free(numbers); }
  };
  std::unique_ptr<double[], Free> numbers_;
  std::size_t size_ = 0;
};

}  // namespace dmocbench::interior_point
