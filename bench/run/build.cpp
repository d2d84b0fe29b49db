#include "bench/run/build.hpp"

namespace dmocbench {

std::string version() { return DMOCBENCH_VERSION; }

std::string compiler() {
#ifdef __clang__
  return __VERSION__;  // begins with a name
#else
  return "g++ " __VERSION__;
#endif
}

}  // namespace dmocbench
