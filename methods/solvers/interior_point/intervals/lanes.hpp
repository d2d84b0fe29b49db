// Included by segment_kernel.cpp alone, once per instruction set and each time inside a namespace of its own.

/// Eight numbers, one per segment of the horizon, that a processor adds and multiplies at a time.
struct Lanes {
  using Vector = double __attribute__((vector_size(8 * sizeof(double))));
  using Mask = long long __attribute__((vector_size(8 * sizeof(long long))));

  Vector v;

  static Lanes all(double value) { return {Vector{} + value}; }

  friend Lanes operator+(const Lanes& a, const Lanes& b) { return {a.v + b.v}; }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return {a.v - b.v}; }
  friend Lanes operator-(const Lanes& a) { return {-a.v}; }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return {a.v * b.v}; }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return {a.v / b.v}; }
  Lanes& operator+=(const Lanes& b) {
    v += b.v;
    return *this;
  }
  Lanes& operator-=(const Lanes& b) {
    v -= b.v;
    return *this;
  }
};

inline Lanes chosen(const Lanes::Mask& mask, const Lanes& yes, const Lanes& no) { return {mask ? yes.v : no.v}; }
inline Lanes smaller(const Lanes& a, const Lanes& b) { return {a.v < b.v ? a.v : b.v}; }
inline Lanes larger(const Lanes& a, const Lanes& b) { return {a.v > b.v ? a.v : b.v}; }
/// The smaller of both, or -1 where the second is not a number: a minimum so far that does not forget it.
inline Lanes least_so_far(const Lanes& so_far, const Lanes& value) {
  return smaller(so_far, chosen(value.v == value.v, value, Lanes::all(-1.0)));
}
inline Lanes magnitude(const Lanes& a) { return larger(a, -a); }

inline Lanes square_root(const Lanes& a) {
  Lanes result;
  for (int lane = 0; lane < 8; ++lane) result.v[lane] = __builtin_sqrt(a.v[lane]);
  return result;
}

/// Rows become columns: entry j of `rows[i]` becomes entry i of `rows[j]`.
inline void transpose(Lanes::Vector (&rows)[8]) {
  Lanes::Vector pairs[8];
  for (int i = 0; i < 8; i += 2) {
    pairs[i] = __builtin_shufflevector(rows[i], rows[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    pairs[i + 1] = __builtin_shufflevector(rows[i], rows[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  Lanes::Vector fours[8];
  for (int i = 0; i < 8; i += 4) {
    for (int j = 0; j < 2; ++j) {
      fours[i + j] = __builtin_shufflevector(pairs[i + j], pairs[i + j + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      fours[i + j + 2] = __builtin_shufflevector(pairs[i + j], pairs[i + j + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (int j = 0; j < 4; ++j) {
    rows[j] = __builtin_shufflevector(fours[j], fours[j + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    rows[j + 4] = __builtin_shufflevector(fours[j], fours[j + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}
