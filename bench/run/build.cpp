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
  Dl_info unused{};
  link_map* object = nullptr;
  const bool is_found = ::dladdr1(reinterpret_cast<const void*>(&own_file), &unused, reinterpret_cast<void**>(&object),
                                  RTLD_DL_LINKMAP) != 0;
  const bool is_module = is_found && object->l_name[0] != '\0';  // the program itself has no name there
  return is_module ? std::filesystem::path(object->l_name) : std::filesystem::read_symlink("/proc/self/exe");
}

}  // namespace dmocbench
