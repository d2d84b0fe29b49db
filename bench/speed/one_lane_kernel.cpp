#include "bench/speed/one_lane_kernel.hpp"

#include <cstddef>
#include <type_traits>
#include <utility>

// NOLINTBEGIN(*-macro-usage,*-avoid-c-arrays): what the fragments below read; arrays that live in registers
#define DMOCBENCH_INLINE [[gnu::always_inline]] inline
#define DMOCBENCH_ANY_SIZE 1
#define DMOCBENCH_COUNT_OPERATIONS(count)

namespace dmocbench::kkt::one_lane {

/// As `Lanes` of methods/runtime/lanes.inc, in plain numbers.
struct Lanes {
  static constexpr int width = 1;
  static constexpr int parts = 8;
  using Vector = double __attribute__((vector_size(8 * sizeof(double))));
  struct Mask {
    bool part[8];
  };

  alignas(sizeof(Vector)) double part[8];

  double operator[](std::size_t lane) const { return part[lane]; }
  void set(std::size_t lane, double value) { part[lane] = value; }

  template <class Result = Lanes, class Operation>
  [[gnu::always_inline]] static Result each(const Operation& operation) {
    return {{operation(0), operation(1), operation(2), operation(3), operation(4), operation(5), operation(6),
             operation(7)}};
  }

  static Lanes all(double value) {
    return each([&](int) { return value; });
  }
  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return each([&](int i) { return a.part[i] + b.part[i]; });
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return each([&](int i) { return a.part[i] - b.part[i]; });
  }
  friend Lanes operator-(const Lanes& a) {
    return each([&](int i) { return -a.part[i]; });
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return each([&](int i) { return a.part[i] * b.part[i]; });
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return each([&](int i) { return a.part[i] / b.part[i]; });
  }
  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator-=(const Lanes& b) { return *this = *this - b; }

  friend Mask operator<(const Lanes& a, const Lanes& b) {
    return each<Mask>([&](int i) { return a.part[i] < b.part[i]; });
  }
  friend Mask operator==(const Lanes& a, const Lanes& b) {
    return each<Mask>([&](int i) { return a.part[i] == b.part[i]; });
  }
  friend Lanes chosen(const Mask& mask, const Lanes& yes, const Lanes& no) {
    return each([&](int i) { return mask.part[i] ? yes.part[i] : no.part[i]; });
  }
};

#include "methods/kkt/intervals/segment_kernel.inc"

}  // namespace dmocbench::kkt::one_lane

namespace dmocbench::speed {

kkt::SegmentKernel one_lane_kernel(const kkt::Shape& shape) {
  return kkt::one_lane::choose<kkt::FixedShape<2, 2, 0, 1, 2>, kkt::FixedShape<2, 2, 0, 2, 2>>(shape);
}

}  // namespace dmocbench::speed

// NOLINTEND(*-macro-usage,*-avoid-c-arrays)
