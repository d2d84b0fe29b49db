#pragma once

#include <cstddef>

// This header is for sources compiled once per instruction set. Before the first of the headers that include this one,
// such a source defines DMOCBENCH_LANES: the name of the inline namespace that all of them are in, one of its own for
// each source, because a linker may take either of two functions of the same name.
#ifndef DMOCBENCH_LANES
#define DMOCBENCH_LANES lanes_of_any_source
#endif

// NOLINTBEGIN(*-avoid-c-arrays,*-member-init,*-reinterpret-cast): arrays that live in registers
namespace dmocbench {
inline namespace DMOCBENCH_LANES {

/// Eight numbers that a processor adds and multiplies at a time, on every instruction set: vector loops and segment
/// kernels give results that depend on the order of sums, and eight lanes keep that order the same everywhere. They
/// take as many registers as the instruction set needs for them, since the compiler keeps a vector that is wider than a
/// register in memory. A tape sums nothing across lanes, so it takes vectors as wide as the processor's, with the
/// functions that xsimd has for them; xsimd has no vector of eight where the processor has none.
struct Lanes {
#if defined(__AVX512F__)
  static constexpr int width = 8;  // of a register
#elif defined(__AVX__)
  static constexpr int width = 4;
#else
  static constexpr int width = 2;
#endif
  static constexpr int parts = 8 / width;
  using Vector = double __attribute__((vector_size(8 * sizeof(double))));
  using Part = double __attribute__((vector_size(width * sizeof(double))));
  struct Mask {
    decltype(Part{} < Part{}) part[parts];
  };

  alignas(sizeof(Vector)) Part part[parts];

  double operator[](std::size_t lane) const { return reinterpret_cast<const double*>(part)[lane]; }
  void set(std::size_t lane, double value) { reinterpret_cast<double*>(part)[lane] = value; }

  /// The value of `operation(i)` for each part i.
  template <class Result = Lanes, class Operation>
  [[gnu::always_inline]] static Result each(const Operation& operation) {
    Result result;
    for (int i = 0; i < parts; ++i) result.part[i] = operation(i);
    return result;
  }

  static Lanes all(double value) {
    return each([&](int) { return Part{} + value; });
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

}  // namespace DMOCBENCH_LANES
}  // namespace dmocbench
// NOLINTEND(*-avoid-c-arrays,*-member-init,*-reinterpret-cast)
