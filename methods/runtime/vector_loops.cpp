#include "methods/runtime/vector_loops.hpp"

#include "methods/runtime/lanes.hpp"

// Compiled once per instruction set, DMOCBENCH_VECTOR_LOOPS being the name that it defines. Everything else is in
// an unnamed namespace, since a linker may take either of two functions of the same name.
namespace dmocbench {

namespace {

constexpr std::ptrdiff_t lanes = 8;
using Vector = Lanes::Vector;

inline Vector load(const double* from) {
  Vector values;
  __builtin_memcpy(&values, from, sizeof values);
  return values;
}
inline void store(const Vector& values, double* to) { __builtin_memcpy(to, &values, sizeof values); }

inline Vector magnitudes(const Vector& values) { return values < 0.0 ? -values : values; }
inline double magnitudes(double value) { return __builtin_fabs(value); }

inline double sum_of(const Vector& values) {
  return ((values[0] + values[4]) + (values[2] + values[6])) + ((values[1] + values[5]) + (values[3] + values[7]));
}

double largest(const double* x, std::ptrdiff_t size) {
  Vector most{};
  std::ptrdiff_t i = 0;
  for (; i + lanes <= size; i += lanes) {
    const Vector some = magnitudes(load(x + i));
    most = most > some ? most : some;
  }
  double result = 0.0;
  for (; i < size; ++i) result = result > __builtin_fabs(x[i]) ? result : __builtin_fabs(x[i]);
  for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) result = result > most[lane] ? result : most[lane];
  return result;
}

/// Σ of a term, which takes entries by `at(x)`: eight of them, or one.
template <class Term>
inline double sum(std::ptrdiff_t size, const Term& term) {
  Vector sums{};
  std::ptrdiff_t i = 0;
  for (; i + lanes <= size; i += lanes) sums += term([i](const double* x) { return load(x + i); });
  double rest = 0.0;
  for (; i < size; ++i) rest += term([i](const double* x) { return x[i]; });
  return sum_of(sums) + rest;
}

double sum_of_magnitudes(const double* x, std::ptrdiff_t size) {
  return sum(size, [x](const auto& at) { return magnitudes(at(x)); });
}

double dot(const double* x, const double* y, std::ptrdiff_t size) {
  return sum(size, [x, y](const auto& at) { return at(x) * at(y); });
}

double sum_of_zeros(const double* x, std::ptrdiff_t size) {
  return sum(size, [x](const auto& at) { return at(x) * 0.0; });
}

void add_products(double* result, const double* x, const double* y, std::ptrdiff_t size) {
  std::ptrdiff_t i = 0;
  for (; i + lanes <= size; i += lanes) store(load(result + i) + load(x + i) * load(y + i), result + i);
  for (; i < size; ++i) result[i] += x[i] * y[i];
}

void set_to_sum(double* result, const double* x, double factor, const double* y, std::ptrdiff_t size) {
  std::ptrdiff_t i = 0;
  for (; i + lanes <= size; i += lanes) store(load(x + i) + factor * load(y + i), result + i);
  for (; i < size; ++i) result[i] = x[i] + factor * y[i];
}

}  // namespace

const VectorLoops DMOCBENCH_VECTOR_LOOPS{largest, sum_of_magnitudes, dot, sum_of_zeros, add_products, set_to_sum};

}  // namespace dmocbench
