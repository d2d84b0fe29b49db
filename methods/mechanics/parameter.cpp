#include "methods/mechanics/parameter.hpp"

#include <cmath>
#include <sstream>

#include "methods/error.hpp"

namespace dmocbench {

std::string Parameter::range() const {
  std::ostringstream text;
  text << (whole ? "a whole number" : "a number") << " in [" << lower << ", " << upper << "]";
  return text.str();
}

void Parameter::check(double candidate) const {
  const bool in_range = std::isfinite(candidate) && candidate >= lower && candidate <= upper;
  if (in_range && (!whole || candidate == std::trunc(candidate))) return;
  std::ostringstream text;
  text << "parameter " << name << " must be " << range();
  if (!unit.empty()) text << " (" << unit << ")";
  text << ", got " << candidate;
  throw Error(text.str());
}

}  // namespace dmocbench
