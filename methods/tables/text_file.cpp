#include "methods/tables/text_file.hpp"

#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "methods/error.hpp"

namespace dmocbench {

std::string read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error(fmt::format("cannot read {}: it is a folder", path.string()));
  }
  if (std::filesystem::is_other(path, ignored)) {
    throw Error(
        fmt::format("cannot read {}: it is no regular file and might have no end; copy it to one", path.string()));
  }
  try {
    std::ifstream stream(path, std::ios::binary);
    std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (stream) return content;
  } catch (const std::ios_base::failure&) {  // the system refuses to read what it has opened
  }
  throw Error(fmt::format("cannot read {}", path.string()));
}

}  // namespace dmocbench
