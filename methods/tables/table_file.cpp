#include "methods/tables/table_file.hpp"

#include <fstream>
#include <iterator>
#include <string>

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
        fmt::format("cannot read {}: it is not a regular file and might have no end; copy it to one", path.string()));
  }
  try {
    std::ifstream stream(path, std::ios::binary);
    std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (stream) return content;
  } catch (const std::ios_base::failure&) {  // the opened file cannot be read
  }
  throw Error(fmt::format("cannot read {}", path.string()));
}

Table table_in(const std::string& text, const std::filesystem::path& file) {
  try {
    return Table::from_csv(text);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

Table read_table(const std::filesystem::path& file) { return table_in(read_file(file), file); }

}  // namespace dmocbench
