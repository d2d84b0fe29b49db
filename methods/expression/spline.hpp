#pragma once

#include <vector>

#include "methods/expression/expression.hpp"

namespace dmocbench {

/// A table as a formula: the natural cubic spline s through the points (x_i, y_i).
///
/// s and its first two derivatives are continuous everywhere; s'' vanishes at both ends, and beyond them s is a
/// straight line. Derivatives of the traced formula are the derivatives of s; the third one, which second derivatives
/// of equations of motion read where a table stands in a Lagrangian, is constant between two points and jumps there.
///
/// A traced value takes about ten operations for every interval of the table: about ten to fifty points are a table,
/// thousands should be thinned out first.
class Spline {
 public:
  /// Throws `Error` unless there are at least two points, as many x as y, all finite, and x ascends.
  Spline(std::vector<double> x, std::vector<double> y);

  /// s(x).
  [[nodiscard]] double operator()(double x) const;
  /// s(x) of a traced number, as a formula with exact first and second derivatives.
  [[nodiscard]] Expression operator()(const Expression& x) const;

 private:
  /// y + d (slope + d (curvature + d third)), d the distance from x.
  struct Cubic {
    double x;
    double y;
    double slope;
    double curvature;
    double third;
    template <class Scalar>
    [[nodiscard]] Scalar at(const Scalar& distance) const {
      return y + distance * (slope + distance * (curvature + distance * third));
    }
  };

  Cubic before_;               // the line before the first point
  std::vector<Cubic> cubics_;  // from each point to the next; last, the line beyond the last point
};

}  // namespace dmocbench
