#include "bench/run/row_store.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "bench/run/build.hpp"
#include "bench/run/json_place.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// The JSON that follows the checksum in a line, with the checksum.
std::string sealed(std::string_view rest) { return fmt::format(R"({{"crc32":"{}",{})", checksum_of(rest), rest); }

/// A JSON object with members as a line, with the checksum of its rest as its first member.
std::string line_of(const Json& entry) {
  return sealed(entry.dump(-1, ' ', false, Json::error_handler_t::replace).substr(1)) + "\n";
}

/// The object in a line; null if the line is damaged.
Json entry_in(const std::string& line) {
  static const std::size_t begin = sealed("").size();
  const std::string rest = line.substr(std::min(begin, line.size()));
  return line == sealed(rest) ? json_or_null("{" + rest) : Json();
}

/// The value at a place; "nothing" if there is no value.
std::string value_at(const Json& json, const std::string& path) {
  const Json::json_pointer place(path);
  return json.contains(place) ? json.at(place).dump() : "nothing";
}

}  // namespace

RowStore::RowStore(std::filesystem::path file, Json header)
    : file_(std::move(file)), header_(std::move(header)), kept_(line_of(header_)), last_sync_(Clock::now()) {}

std::vector<Json> RowStore::resume() const {
  std::error_code none;  // a missing file is not a regular file
  if (!std::filesystem::is_regular_file(file_, none)) return {};
  StoredEntries stored = read_store(file_);
  if (!stored.header.contains("identity") || stored.header.at("identity") != header_.at("identity")) return {};
  return std::move(stored.entries);
}

void RowStore::keep(const Json& entry) { kept_ += line_of(entry); }

void RowStore::append(const Json& entry) {
  if (file_.empty()) return;
  if (!has_file_) {
    write_file(file_, kept_ + line_of(entry));
    has_file_ = true;
    return kept_.clear();
  }
  append_to_file(file_, line_of(entry));
  constexpr double seconds_between_syncs = 20.0;
  if (seconds_since(last_sync_) > seconds_between_syncs) sync();
}

void RowStore::sync() {
  if (has_file_) force_to_disk(file_);
  last_sync_ = Clock::now();
}

void RowStore::remove() const {
  std::error_code none;  // it need not be there
  if (!file_.empty()) std::filesystem::remove(file_, none);
}

StoredEntries read_store(const std::filesystem::path& file) {
  StoredEntries store{.file = file, .header = {}, .entries = {}};
  const std::string content = read_file(file);
  std::size_t number = 1;
  for (std::size_t begin = 0; begin < content.size(); ++number) {
    const std::size_t end = std::min(content.find('\n', begin), content.size());
    Json entry = end == content.size() ? Json() : entry_in(content.substr(begin, end - begin));
    begin = end + 1;
    if (entry.is_object()) {
      if (number == 1) {
        store.header = std::move(entry);
      } else {
        store.entries.push_back(std::move(entry));
      }
    } else if (begin < content.size()) {
      throw Error("line {} of {} is damaged; remove the file and run its cases again", number, file.string());
    }
  }
  return store;
}

Json identity_of(const std::string& experiment, const Json& metadata, const std::map<std::string, std::string>& options,
                 const Json& parameters) {
  Json identity{{"experiment", experiment}};
  for (const char* const key : {"dmocbench", "compiler", "flags", "instruction_set", "software", "solvers"}) {
    identity[key] = metadata.at(key);
  }
  // Not the commit: a tree that was changed has several programs under one, and one program outlives many.
  identity["program"] = checksum_of(read_file(own_file()));
  if (metadata.contains("problem_libraries")) {
    for (const Json& library : metadata.at("problem_libraries")) {  // their folders may differ between machines
      const std::filesystem::path path = library.at("path").get<std::string>();
      identity["problem_libraries"][path.filename().string()] = library.at("crc32");
    }
  }
  identity["parameters"] = parameters;  // before the options: a difference is reported by its first entry
  identity["options"] = options;
  return identity;
}

Json header_of_store(Json identity, const Json& metadata) {
  Json header{{"identity", std::move(identity)}, {"machine", {{"host", host_name()}}}};
  for (const char* const key : {"commit", "utc_time"}) header[key] = metadata.at(key);
  for (const char* const key : {"processor", "cores", "memory_gib", "operating_system"})
    header["machine"][key] = metadata.at(key);
  return header;
}

void require_same_run(const StoredEntries& store, const Json& header) {
  const JsonPlace stored(store.header, store.file.string());
  const Json& identity = stored.at("identity").json();
  const Json& wanted = header.at("identity");
  const Json difference = Json::diff(wanted, identity);
  if (difference.empty()) return;
  const std::string path = difference.front().at("path");
  std::string place = path.substr(std::min<std::size_t>(1, path.size()));
  std::ranges::replace(place, '/', ' ');
  const std::string commits = path != "/program" ? ""
                                                 : fmt::format(" (built from commit {}, not {})",
                                                               stored.at("commit").text(), header.at("commit").dump());
  throw Error("{} belongs to another run: {} is {}, not {}{}; run its cases again, or remove it", store.file.string(),
              place, value_at(identity, path), value_at(wanted, path), commits);
}

}  // namespace dmocbench
