#include "methods/tables/table_file.hpp"

#include <string>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/tables/text_file.hpp"

namespace dmocbench {

Table table_in(const std::string& text, const std::filesystem::path& file) {
  try {
    return Table::from_csv(text);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

Table read_table(const std::filesystem::path& file) { return table_in(read_file(file), file); }

}  // namespace dmocbench
