#include "bench/run/finished_stages.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "bench/run/result_file.hpp"
#include "bench/run/written_tables.hpp"
#include "methods/error.hpp"
#include "methods/tables/table_file.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

Json table_in_json(const TableFile& file) {
  const Table& table = file.table;
  Json types = Json::object();
  for (const auto& [column, type] : table.types()) types[column] = {static_cast<int>(type.kind), type.may_be_empty};
  return {{"file", file.file.string()}, {"csv", table.csv()}, {"meanings", table.meanings()},
          {"types", std::move(types)},  {"key", table.key()}, {"not_measured", file.not_measured}};
}

TableFile table_from_json(const Json& json) {
  TableFile file{.file = json.at("file").get<std::string>(),
                 .table = Table::from_csv(json.at("csv").get<std::string>()),
                 .not_measured = json.at("not_measured").get<std::ptrdiff_t>()};
  file.table.explain(json.at("meanings").get<std::map<std::string, std::string>>());
  std::map<std::string, FieldType> types;
  for (const auto& [column, type] : json.at("types").items())
    types[column] = {static_cast<FieldKind>(type.at(0).get<int>()), type.at(1).get<bool>()};
  file.table.declare(types);
  file.table.set_key(json.at("key").get<std::vector<std::string>>());
  return file;
}

std::string checksum_of_stages(const Json& content) { return fmt::format("{:08x}", crc_32(content.dump())); }

}  // namespace

bool FinishedStages::contain(const std::string& stage) const {
  return std::ranges::find(names_, stage) != names_.end();
}

std::vector<TableFile> FinishedStages::resume() {
  std::error_code none;  // a missing file is not a regular file
  if (!std::filesystem::is_regular_file(file_, none)) return {};
  const Json saved = Json::parse(read_file(file_), nullptr, false);
  if (!saved.is_object() || !saved.contains("content") || !saved.contains("crc32")) return {};
  const Json& content = saved["content"];
  if (saved["crc32"] != checksum_of_stages(content) || content.at("identity") != identity_) return {};
  names_ = content.at("stages").get<std::vector<std::string>>();
  std::vector<TableFile> tables;
  for (const Json& table : content.at("tables")) tables.push_back(table_from_json(table));
  return tables;
}

void FinishedStages::add(const std::string& stage, const std::vector<TableFile>& tables) {
  names_.push_back(stage);
  Json content{{"identity", identity_}, {"stages", names_}, {"tables", Json::array()}};
  for (const TableFile& table : tables) content["tables"].push_back(table_in_json(table));
  const std::string checksum = checksum_of_stages(content);
  write_file(file_, Json{{"crc32", checksum}, {"content", std::move(content)}}.dump());
}

void FinishedStages::forget() const {
  std::error_code none;  // it need not be there
  if (!file_.empty()) std::filesystem::remove(file_, none);
}

}  // namespace dmocbench
