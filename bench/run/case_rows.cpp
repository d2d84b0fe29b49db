#include "bench/run/case_rows.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/run/indirect_reference.hpp"
#include "bench/run/json_place.hpp"
#include "methods/error.hpp"
#include "methods/program/status.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// Throws `Error` if a row has a value that no run writes: an invalid number, or an answer without its cost.
void require_measured(const Row& row, const std::vector<std::string>& columns, const std::string& place) {
  const auto refuse = [&](const std::string& column) {
    throw Error("{}: {} is {}, expected a finite number; remove the file and run its cases again", place, column,
                row.text(column).empty() ? "missing" : row.text(column));
  };
  for (const std::string& column : columns) {
    const auto number = parsed<double>(row.text(column));
    if (number && !std::isfinite(*number)) refuse(column);
  }
  if (is_solved(status_named(row.text("status"))) && !row.number("objective")) refuse("objective");
}

/// The stores of parts of a run in a results folder, in the order of their names.
std::vector<std::filesystem::path> stores_of_parts(const std::filesystem::path& folder, const std::string& name) {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path parts = folder_of_parts(folder, name);
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(parts, none)) {
    const std::filesystem::path& path = entry.path();
    std::error_code unknown;  // reading anything but a regular file may never end
    const bool is_file = entry.is_regular_file(unknown);
    if (is_file && path.extension() == ".rows" && !path.filename().string().starts_with('.')) files.push_back(path);
  }
  if (files.empty()) {
    throw Error("there are no parts of {} in {}{}; run the command with --part 1/n to n/n first", name, parts.string(),
                none ? ": " + none.message() : "");
  }
  std::ranges::sort(files);
  return files;
}

/// Describes the machines that the parts of a run ran on in its metadata.
void describe_parts(const std::vector<Json>& headers, std::size_t parts, Json& metadata) {
  Json machines = Json::array();
  std::vector<std::string> times;
  for (const Json& header : headers) {
    const Json& machine = header.at("machine");
    if (std::ranges::find(machines, machine) == machines.end()) machines.push_back(machine);
    times.push_back(header.at("utc_time"));
  }
  // Times in the table were measured on these machines, not on the one that joins the parts.
  for (const auto& [key, first] : machines.front().items()) {
    const auto is_equal = [&key = key, &first = first](const Json& machine) {
      return machine.value(key, Json()) == first;
    };
    if (metadata.contains(key))
      metadata[key] = std::ranges::all_of(machines, is_equal) ? first : Json("several, see parts");
  }
  const auto [first, last] = std::ranges::minmax(times);
  metadata["parts"] = {
      {"of", parts}, {"first_utc_time", first}, {"last_utc_time", last}, {"machines", std::move(machines)}};
}

/// Throws `Error` unless a header, which others may have written, has what `describe_parts` reads.
void require_described(const StoredEntries& store) {
  const JsonPlace header(store.header, store.file.string());
  static_cast<void>(parse_part("the part", header.at("part").text()));
  static_cast<void>(header.at("utc_time").text());
  static_cast<void>(header.at("machine").at("host").text());
}

}  // namespace

CaseRows::CaseRows(Experiment& experiment, std::size_t cases, std::vector<std::string> columns, RowStore store)
    : experiment_(experiment), columns_(std::move(columns)), rows_(cases), store_(std::move(store)) {}

Table CaseRows::table() const {
  Table table(columns_);
  for (const std::optional<Row>& row : rows_) {
    if (row) table.append(*row);
  }
  return table;
}

Json CaseRows::entry_of(std::size_t number, const Row& row) const {
  Json fields = Json::array();
  for (const std::string& column : columns_) fields.push_back(row.text(column));
  return {{"case", number + 1}, {"row", std::move(fields)}};
}

void CaseRows::keep(std::size_t number, Row row) {
  Json entry = entry_of(number, row);
  rows_[number] = std::move(row);
  if (experiment_.indirect() != nullptr) {
    if (Json findings = experiment_.indirect()->findings(); findings != findings_)
      entry["findings"] = findings_ = std::move(findings);
  }
  store_.append(entry);
}

std::vector<std::size_t> CaseRows::take(const StoredEntries& stored) {
  std::vector<std::size_t> numbers;
  for (const Json& entry : stored.entries) {
    const JsonPlace place(entry, stored.file.string());
    const auto number = static_cast<std::size_t>(place.at("case").count());
    const std::vector<std::string> fields = place.at("row").texts();
    const std::string name = fmt::format("{}: case {}", stored.file.string(), number);
    if (number < 1 || number > rows_.size() || fields.size() != columns_.size())
      throw Error("{} with {} fields was written by another run; remove the file", name, fields.size());
    Row row;
    for (std::size_t i = 0; i < fields.size(); ++i) row.set(columns_[i], fields[i]);
    require_measured(row, columns_, name);
    rows_[number - 1] = std::move(row);
    numbers.push_back(number - 1);
    if (experiment_.indirect() != nullptr && place.has("findings"))
      experiment_.indirect()->add_findings(place.at("findings"));
  }
  return numbers;
}

std::size_t CaseRows::resume(const std::vector<std::size_t>& groups) {
  take({.file = store_.file(), .header = {}, .entries = store_.resume()});
  std::vector<bool> is_whole(rows_.size(), true);  // by the first case of a group
  for (std::size_t i = 0; i < rows_.size(); ++i) is_whole[groups[i]] = is_whole[groups[i]] && rows_[i];
  std::size_t resumed = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!is_whole[groups[i]]) rows_[i].reset();
    if (!rows_[i]) continue;
    store_.keep(entry_of(i, *rows_[i]));
    ++resumed;
  }
  return resumed;
}

std::vector<std::size_t> CaseRows::collect(const std::filesystem::path& file) {
  std::error_code none;  // a process that was interrupted before its first row has no file
  if (!std::filesystem::exists(file, none)) return {};
  std::vector<std::size_t> numbers = take(read_store(file));
  for (const std::size_t number : numbers) {
    if (const std::optional<Row>& row = rows_[number]) keep(number, *row);
  }
  std::filesystem::remove(file, none);
  return numbers;
}

void CaseRows::join(const RunPlan& plan, Json& metadata) {
  const ExperimentOptions& options = experiment_.options();
  std::vector<Json> headers;
  std::vector<std::filesystem::path> origins(rows_.size());
  for (const std::string& folder : options.join) {
    for (const std::filesystem::path& file : stores_of_parts(folder, options.name)) {
      const StoredEntries store = read_store(file);
      if (store.header.is_null()) continue;  // its first line was never finished
      require_same_run(store, store_.header());
      require_described(store);
      for (const std::size_t number : take(store)) {
        const std::filesystem::path origin = std::exchange(origins[number], file);
        if (origin.empty() || origin == file) continue;
        throw Error("{} exists twice ({} and {}); remove one of the files", plan.cases()[number].label(),
                    origin.string(), file.string());
      }
      headers.push_back(store.header);
    }
  }
  const std::size_t parts =
      headers.empty() ? 1 : parse_part("the part", headers.front().at("part").get<std::string>()).of;
  require_all(plan, parts);
  describe_parts(headers, parts, metadata);
}

void CaseRows::require_all(const RunPlan& plan, std::size_t parts) const {
  const std::vector<std::size_t> part_of = dealt_out(plan.cases(), plan.groups_of_starts(), parts);
  std::set<std::size_t> numbers;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!rows_[i]) numbers.insert(part_of[i]);
  }
  if (numbers.empty()) return;
  const std::vector<std::size_t> missing(numbers.begin(), numbers.end());
  const auto lost = std::ranges::count(rows_, false, &std::optional<Row>::has_value);
  throw Error("{} of {} cases have no row: part{} {} of {} {} missing or incomplete; run {} with --part {}/{}", lost,
              rows_.size(), missing.size() > 1 ? "s" : "", in_ranges(missing), parts, missing.size() > 1 ? "are" : "is",
              missing.size() > 1 ? "each" : "it", missing.front(), parts);
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
