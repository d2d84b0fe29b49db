#include "bench/experiment/meanings.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "bench/experiment/result_file.hpp"
#include "bench/experiment/written_tables.hpp"

namespace dmocbench {

void add_meanings(nlohmann::ordered_json& metadata, const std::filesystem::path& file, const Table& table) {
  for (const std::string& column : table.columns()) {
    const auto meaning = table.meanings().find(column);
    if (meaning != table.meanings().end())
      metadata["tables"][file.filename().string()]["meanings"][column] = meaning->second;
  }
}

void write_table(const std::filesystem::path& file, const Table& table, nlohmann::ordered_json& metadata) {
  write_file(file, table.csv());
  add_meanings(metadata, file, table);
}

void describe_tables_of_run(const std::vector<std::filesystem::path>& files,
                            const std::map<std::string, std::string>& of_rows, nlohmann::ordered_json& metadata) {
  using Json = nlohmann::ordered_json;
  const Json noted = metadata.value("tables", Json::object());
  Json tables = describe_tables(files);
  for (auto& [file, told] : tables.items()) {
    const Json own = noted.contains(file) ? noted.at(file).at("meanings") : Json::object();
    const auto columns = told.at("columns").get<std::vector<std::string>>();  // an entry more may move the others
    for (const std::string& column : columns) {
      const auto of_row = of_rows.find(column);
      if (own.contains(column)) {
        told["meanings"][column] = own.at(column);
      } else if (of_row != of_rows.end()) {
        told["meanings"][column] = of_row->second;
      }
    }
  }
  metadata["tables"] = std::move(tables);
}

}  // namespace dmocbench
