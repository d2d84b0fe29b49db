#include "methods/expression/operation.hpp"

namespace dmocbench {

std::string_view name_of(Operation operation) noexcept {
  switch (operation) {
    case Operation::constant:
      return "constant";
    case Operation::input:
      return "input";
    case Operation::add:
      return "+";
    case Operation::subtract:
      return "-";
    case Operation::multiply:
      return "*";
    case Operation::divide:
      return "/";
    case Operation::negate:
      return "negate";
    case Operation::reciprocal:
      return "reciprocal";
    case Operation::square_root:
      return "sqrt";
    case Operation::exponential:
      return "exp";
    case Operation::logarithm:
      return "log";
    case Operation::sine:
      return "sin";
    case Operation::cosine:
      return "cos";
    case Operation::tangent:
      return "tan";
    case Operation::arc_sine:
      return "asin";
    case Operation::arc_cosine:
      return "acos";
    case Operation::arc_tangent:
      return "atan";
    case Operation::arc_tangent2:
      return "atan2";
    case Operation::hyperbolic_sine:
      return "sinh";
    case Operation::hyperbolic_cosine:
      return "cosh";
    case Operation::hyperbolic_tangent:
      return "tanh";
    case Operation::power:
      return "pow";
  }
  return "unknown";
}

}  // namespace dmocbench
