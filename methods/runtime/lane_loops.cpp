#include "methods/runtime/lane_loops.hpp"

#include "methods/runtime/lanes.hpp"

// Compiled once per instruction set, DMOCBENCH_LANE_LOOPS being the name that it defines. Everything else is in an
// unnamed namespace, since a linker may take either of two functions of the same name.
namespace dmocbench {

namespace {

constexpr std::ptrdiff_t lanes = 8;
static_assert(lanes == instance_lanes);

inline Lanes load(const double* from) {
  Lanes values{};
  __builtin_memcpy(&values, from, sizeof values);
  return values;
}
inline void store(const Lanes& values, double* to) { __builtin_memcpy(to, &values, sizeof values); }
inline Lanes magnitude(const Lanes& x) { return chosen(x < Lanes{}, -x, x); }
inline Lanes larger(const Lanes& a, const Lanes& b) { return chosen(b < a, a, b); }

/// Σ term(i)
template <class Term>
inline void sum_up(std::ptrdiff_t size, const Term& term, double* result) {
  Lanes total{};
  for (std::ptrdiff_t i = 0; i < size; ++i) total += term(i * lanes);
  store(total, result);
}

void sum(const double* x, std::ptrdiff_t size, double* result) {
  sum_up(
      size, [&](std::ptrdiff_t i) { return load(x + i); }, result);
}

void magnitudes(const double* x, std::ptrdiff_t size, double* sum, double* largest) {
  Lanes most{};
  Lanes total{};
  for (std::ptrdiff_t i = 0; i < size * lanes; i += lanes) {
    const Lanes size_of_entry = magnitude(load(x + i));
    total += size_of_entry;
    most = larger(most, size_of_entry);
  }
  store(total, sum);
  store(most, largest);
}

void largest(const double* x, std::ptrdiff_t size, double* result) {
  Lanes most{};
  for (std::ptrdiff_t i = 0; i < size; ++i) most = larger(most, magnitude(load(x + i * lanes)));
  store(most, result);
}

void dot(const double* x, const double* y, std::ptrdiff_t size, double* result) {
  sum_up(
      size, [&](std::ptrdiff_t i) { return load(x + i) * load(y + i); }, result);
}

void subtract(double* x, const double* y, std::ptrdiff_t size, double* sum, double* largest) {
  Lanes most{};
  Lanes total{};
  for (std::ptrdiff_t i = 0; i < size * lanes; i += lanes) {
    const Lanes rest = load(x + i) - load(y + i);
    store(rest, x + i);
    total += magnitude(rest);
    most = larger(most, magnitude(rest));
  }
  store(total, sum);
  store(most, largest);
}

void set_to_sum(double* result, const double* x, const double* factor, const double* y, std::ptrdiff_t size) {
  const Lanes by = load(factor);
  const Lanes::Mask stays = by == Lanes{};
  for (std::ptrdiff_t i = 0; i < size * lanes; i += lanes) {
    const Lanes from = load(x + i);
    store(chosen(stays, from, from + by * load(y + i)), result + i);
  }
}

void sum_of_reciprocals(const double* x, const double* y, double least, std::ptrdiff_t size, double* result) {
  const Lanes smallest = Lanes::all(least);
  const Lanes one = Lanes::all(1.0);
  const auto term = [&](std::ptrdiff_t i) {
    const Lanes value = x != nullptr ? load(x + i) + load(y + i) : load(y + i);
    return one / (magnitude(value) + smallest);
  };
  sum_up(size, term, result);
}

}  // namespace

const LaneLoops DMOCBENCH_LANE_LOOPS{sum, magnitudes, largest, dot, subtract, set_to_sum, sum_of_reciprocals};

}  // namespace dmocbench
