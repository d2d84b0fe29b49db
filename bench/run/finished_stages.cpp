#include "bench/run/finished_stages.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "bench/run/json_place.hpp"
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
  for (const auto& [column, type] : table.types())
    types[column] = {{"kind", static_cast<unsigned>(type.kind)}, {"may_be_empty", type.may_be_empty}};
  return {{"name", file.file.stem().string()}, {"csv", table.csv()}, {"meanings", table.meanings()},
          {"types", std::move(types)},         {"key", table.key()}, {"not_measured", file.not_measured}};
}

/// The file of a table in the folder of the file `unfinished`. Throws `Error` unless its name begins with the run's.
std::filesystem::path file_of_table(const std::filesystem::path& unfinished, const std::string& name) {
  if (!name.starts_with(unfinished.stem().string()) || name.find('/') != std::string::npos) {
    throw Error(fmt::format("{} names the table \"{}\", which is not one of this run; remove the file",
                            unfinished.string(), name));
  }
  return unfinished.parent_path() / (name + ".csv");
}

TableFile table_from_json(const JsonPlace& json, const std::filesystem::path& unfinished) {
  TableFile file{.file = file_of_table(unfinished, json.at("name").text()),
                 .table = Table::from_csv(json.at("csv").text()),
                 .not_measured = json.at("not_measured").count()};
  std::map<std::string, std::string> meanings;
  for (const auto& [column, meaning] : json.at("meanings").members()) meanings[column] = meaning.text();
  file.table.explain(meanings);
  std::map<std::string, FieldType> types;
  for (const auto& [column, type] : json.at("types").members())
    types[column] = {static_cast<FieldKind>(type.at("kind").count()), type.at("may_be_empty").boolean()};
  file.table.declare(types);
  file.table.set_key(json.at("key").texts());
  return file;
}

std::string in_one_line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string checksum_of_stages(const Json& content) { return fmt::format("{:08x}", crc_32(in_one_line(content))); }

}  // namespace

bool FinishedStages::contain(const std::string& stage) const {
  return std::ranges::find(names_, stage) != names_.end();
}

std::vector<TableFile> FinishedStages::resume() {
  std::error_code none;  // a missing file is not a regular file
  if (!std::filesystem::is_regular_file(file_, none)) return {};
  const Json saved = json_or_null(read_file(file_));
  const JsonPlace file(saved, file_.string());
  if (!file.has("content") || !file.has("crc32")) return {};
  const JsonPlace content = file.at("content");
  if (file.at("crc32").json() != checksum_of_stages(content.json())) return {};
  if (!content.has("identity") || content.at("identity").json() != identity_) return {};
  std::vector<TableFile> tables;
  for (const JsonPlace& table : content.at("tables").entries()) tables.push_back(table_from_json(table, file_));
  names_ = content.at("stages").texts();
  return tables;
}

void FinishedStages::add(const std::string& stage, const std::vector<TableFile>& tables) {
  names_.push_back(stage);
  Json content{{"identity", identity_}, {"stages", names_}, {"tables", Json::array()}};
  for (const TableFile& table : tables) content["tables"].push_back(table_in_json(table));
  const std::string checksum = checksum_of_stages(content);
  write_file(file_, in_one_line(Json{{"crc32", checksum}, {"content", std::move(content)}}));
}

void FinishedStages::forget() const {
  std::error_code none;  // it need not be there
  if (!file_.empty()) std::filesystem::remove(file_, none);
}

}  // namespace dmocbench
