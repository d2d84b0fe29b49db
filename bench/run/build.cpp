#include "bench/run/build.hpp"

#include <dlfcn.h>
#include <link.h>

namespace dmocbench {

std::string version() { return DMOCBENCH_VERSION; }

std::string compiler() {
#ifdef __clang__
  return __VERSION__;  // begins with a name
#else
  return "g++ " __VERSION__;
#endif
}

std::filesystem::path own_file() {
  static const char of_this_file = 0;
  Dl_info unused{};
  void* object = nullptr;
  if (::dladdr1(&of_this_file, &unused, &object, RTLD_DL_LINKMAP) == 0) object = nullptr;
  const char* const name = object == nullptr ? "" : static_cast<const link_map*>(object)->l_name;
  return *name != '\0' ? std::filesystem::path(name) : std::filesystem::read_symlink("/proc/self/exe");
}

}  // namespace dmocbench
