#include "methods/tables/table_file.hpp"

#include <string>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/tables/text_file.hpp"

namespace dmocbench {

Table read_table(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  try {
    return Table::from_csv(text);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace dmocbench
