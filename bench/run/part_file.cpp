#include "bench/run/part_file.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/run/json_place.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/run_identity.hpp"
#include "bench/run/written_tables.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

std::string checksum_in_words(const std::string& description, const std::string& table) {
  return fmt::format("{:08x}", crc_32(description + table));
}

/// The place of an entry in words, from a path of `diff` such as "/options/--tolerance".
std::string entry_in_words(std::string path) {
  std::ranges::replace(path, '/', ' ');
  return path.substr(std::min<std::size_t>(1, path.size()));
}

/// The value at a place; "nothing" if there is no value.
std::string value_at(const Json& json, const std::string& path) {
  const Json::json_pointer place(path);
  return json.contains(place) ? json.at(place).dump() : "nothing";
}

/// Throws `Error` unless a description has all entries that are read, of the right types: a checksum detects damage,
/// but not files written by others.
void require_whole(const JsonPlace& description) {
  static_cast<void>(parse_part("the part", description.at("part").text()));
  for (const char* const key : {"commit", "utc_time"}) static_cast<void>(description.at(key).text());
  static_cast<void>(description.at("identity").at("experiment").text());
  static_cast<void>(description.at("command_line").texts());
  for (const char* const key : keys_of_machine) static_cast<void>(description.at("machine").at(key));
  static_cast<void>(description.at("findings"));
}

std::vector<std::filesystem::path> part_files_in(const std::vector<std::filesystem::path>& folders,
                                                 const std::string& name) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path parts = folder_of_parts(folder / name);
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(parts, none)) {
      const std::filesystem::path& path = entry.path();
      std::error_code unknown;  // reading anything but a regular file may never end
      const bool is_file = entry.is_regular_file(unknown);
      if (is_file && path.extension() == ".part" && !path.filename().string().starts_with('.')) files.push_back(path);
    }
    if (none) throw Error(fmt::format("there are no parts of {} in {}: {}", name, parts.string(), none.message()));
  }
  if (files.empty()) {
    throw Error(fmt::format("there are no parts of {0} in {1}; run it with --part 1/n to n/n first", name,
                            folder_of_parts(folders.front() / name).string()));
  }
  return files;
}

/// Throws `Error` unless every part is there once.
void require_each_once(const std::vector<PartFile>& files) {
  const std::size_t parts = files.front().part().of;
  std::vector<const PartFile*> found(parts + 1, nullptr);
  for (const PartFile& file : files) {
    const PartFile*& known = found[file.part().number];
    if (known != nullptr) {
      throw Error(fmt::format("part {} is there twice, {} and {}: remove one", file.part().in_words(),
                              known->path.string(), file.path.string()));
    }
    known = &file;
  }
  std::vector<std::size_t> missing;
  for (std::size_t number = 1; number <= parts; ++number) {
    if (found[number] == nullptr) missing.push_back(number);
  }
  if (missing.empty()) return;
  throw Error(fmt::format("part{} {} of {} {} missing in {}; run {} with --part {}/{} too",
                          missing.size() > 1 ? "s" : "", in_ranges(missing), parts, missing.size() > 1 ? "are" : "is",
                          files.front().path.parent_path().string(), missing.size() > 1 ? "each" : "it",
                          missing.front(), parts));
}

}  // namespace

Part PartFile::part() const { return parse_part("the part", description.at("part").get<std::string>()); }

std::filesystem::path folder_of_parts(const std::filesystem::path& prefix) { return prefix.string() + ".parts"; }

void write_part(const PartFile& file) {
  const std::string description = file.description.dump(-1, ' ', false, Json::error_handler_t::replace);
  write_file(file.path, fmt::format("{} {}\n{}", checksum_in_words(description, file.table), description, file.table));
}

PartFile read_part(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  const std::size_t line = std::min(content.find('\n'), content.size());
  const std::size_t space = std::min(content.find(' '), line);
  const std::string description = content.substr(std::min(space + 1, line), line - std::min(space + 1, line));
  PartFile file{.path = path,
                .description = json_or_null(description),
                .table = content.substr(std::min(line + 1, content.size()))};
  if (content.substr(0, space) != checksum_in_words(description, file.table) || !file.description.is_object()) {
    throw Error(fmt::format("{} is damaged or not a part; remove it and run that part again", path.string()));
  }
  require_whole({file.description, path.string()});
  return file;
}

std::vector<PartFile> read_all_parts(const std::vector<std::filesystem::path>& folders, const std::string& name) {
  std::vector<PartFile> files;
  for (const std::filesystem::path& path : part_files_in(folders, name)) files.push_back(read_part(path));
  std::ranges::sort(files, {}, [](const PartFile& file) { return std::pair(file.part().of, file.part().number); });
  const PartFile& first = files.front();
  for (const PartFile& file : files) {
    if (file.part().of != first.part().of) {
      throw Error(fmt::format("{} is one of {} parts and {} one of {}: remove the parts of one run", file.path.string(),
                              file.part().of, first.path.string(), first.part().of));
    }
    require_same_run(fmt::format("{} is of another run than {}", file.path.string(), first.path.filename().string()),
                     file.description, first.description);
  }
  require_each_once(files);
  return files;
}

void require_same_run(const std::string& who, const Json& description, const Json& wanted) {
  const Json& identity = description.at("identity");
  const Json& wanted_identity = wanted.at("identity");
  const Json difference = Json::diff(wanted_identity, identity);
  if (difference.empty()) return;
  const std::string path = difference.front().at("path");
  const std::string commits =
      path != "/program" ? ""
                         : fmt::format(" (built from commit {}, not {})", description.at("commit").get<std::string>(),
                                       wanted.at("commit").get<std::string>());
  throw Error(fmt::format("{}: {} is {}, not {}{}; run that part again, or remove it", who, entry_in_words(path),
                          value_at(identity, path), value_at(wanted_identity, path), commits));
}

std::string in_ranges(const std::vector<std::size_t>& numbers) {
  std::vector<std::string> ranges;
  for (std::size_t first = 0; first < numbers.size();) {
    std::size_t last = first;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    const char* const between = last == first + 1 ? " and " : " to ";
    ranges.push_back(last == first ? fmt::format("{}", numbers[first])
                                   : fmt::format("{}{}{}", numbers[first], between, numbers[last]));
    first = last + 1;
  }
  return fmt::format("{}", fmt::join(ranges, ", "));
}

}  // namespace dmocbench
