#include "methods/expression/smooth.hpp"

#include "methods/error.hpp"

namespace dmocbench {

namespace {

void require_width(double eps, const char* function) {
  if (eps > 0.0) return;
  throw Error("{} needs a transition width eps > 0, got {:g}", function, eps);
}

Expression rounded_magnitude(const Expression& x, double eps) { return sqrt(x * x + eps * eps); }

}  // namespace

Expression smooth_abs(const Expression& x, double eps) {
  require_width(eps, "smooth_abs");
  return rounded_magnitude(x, eps);
}

Expression smooth_max(const Expression& x, const Expression& y, double eps) {
  require_width(eps, "smooth_max");
  return 0.5 * (x + y + rounded_magnitude(x - y, eps));
}

Expression smooth_min(const Expression& x, const Expression& y, double eps) {
  require_width(eps, "smooth_min");
  return 0.5 * (x + y - rounded_magnitude(x - y, eps));
}

Expression smooth_sign(const Expression& x, double eps) {
  require_width(eps, "smooth_sign");
  return x / rounded_magnitude(x, eps);
}

Expression smooth_if_else(const Expression& x, const Expression& a, const Expression& b, double eps) {
  require_width(eps, "smooth_if_else");
  return 0.5 * (a + b) + 0.5 * (a - b) * tanh(x / eps);
}

}  // namespace dmocbench
