#include "bench/run/parts_of_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bench/run/indirect_reference.hpp"
#include "bench/run/json_place.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/run_identity.hpp"
#include "methods/error.hpp"
#include "methods/program/status.hpp"
#include "methods/runtime/parsed.hpp"
#include "methods/tables/table_file.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* case_column = "case";

/// The respects in which cases of one experiment depend on each other.
std::vector<SharedBy> respects_of(const Experiment& experiment) {
  const auto scheme = [](const Case& c) { return fmt::format("{} {} {}", c.problem->name(), c.tableau, c.stages); };
  const ExperimentCard& card = experiment.card();
  std::vector<SharedBy> respects{[](const Case& the_case) { return the_case.shares; }};
  if (card.takes_turns) {
    respects.emplace_back([scheme](const Case& c) { return fmt::format("{} {}", scheme(c), c.intervals()); });
  }
  return respects;
}

/// The same if the common start of a scheme has to be found once.
std::vector<SharedBy> respects_of_parts(const Experiment& experiment) {
  const auto scheme = [](const Case& c) { return fmt::format("{} {} {}", c.problem->name(), c.tableau, c.stages); };
  const ExperimentCard& card = experiment.card();
  std::vector<SharedBy> respects = respects_of(experiment);
  const std::string& start = card.options.start;
  if (start == "common" || (start == "guess" && card.branches == BranchReport::of_any_start))
    respects.emplace_back(scheme);
  return respects;
}

/// Throws `Error` if a row has a value that no run writes: an invalid number, or an answer without its cost.
void require_measured(const Row& row, const std::vector<std::string>& columns, const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& column) {
    throw Error(fmt::format("{}: {} of case {} is {}, which no run writes; remove the file and run that part again",
                            file.string(), column, row.text(case_column),
                            row.text(column).empty() ? "missing" : row.text(column)));
  };
  for (const std::string& column : columns) {
    const auto number = parsed<double>(row.text(column));
    if (number && !std::isfinite(*number)) refuse(column);
  }
  if (is_solved(status_named(row.text("status"))) && !row.number("objective")) refuse("objective");
}

/// Describes the parts of the whole run and the machines that they ran on in its metadata.
void describe_parts(const std::vector<PartFile>& files, Json& metadata) {
  Json machines = Json::array();
  std::vector<std::vector<std::size_t>> numbers;
  std::vector<std::string> times;
  for (const PartFile& file : files) {
    const Json& machine = file.description.at("machine");
    const auto found = std::ranges::find(machines, machine);
    const auto position = static_cast<std::size_t>(found - machines.begin());
    if (found == machines.end()) {
      machines.push_back(machine);
      numbers.emplace_back();
    }
    numbers[position].push_back(file.part().number);
    times.push_back(file.description.at("utc_time"));
  }
  // Times in the table were measured on these machines, not on the one that joins the parts.
  for (const char* const key : keys_of_machine) {
    const Json& first = machines.front().at(key);
    const auto is_equal = [key, &first](const Json& machine) { return machine.at(key) == first; };
    metadata[key] = std::ranges::all_of(machines, is_equal) ? first : Json("several, see parts");
  }
  for (std::size_t i = 0; i < machines.size(); ++i) machines[i]["parts"] = in_ranges(numbers[i]);
  const auto [first, last] = std::ranges::minmax(times);
  metadata["parts"] = {
      {"of", files.size()}, {"first_utc_time", first}, {"last_utc_time", last}, {"machines", std::move(machines)}};
}

/// The command line of the whole run, from the command line that joins parts.
void forget_joining(Json& command_line) {
  Json words = Json::array();
  for (std::size_t i = 0; i < command_line.size(); ++i) {
    const auto word = command_line[i].get<std::string>();
    if (word == "--join") ++i;  // and the folder
    if (word != "--join" && !word.starts_with("--join=")) words.push_back(word);
  }
  command_line = std::move(words);
}

}  // namespace

PartsOfRun::PartsOfRun(Experiment& experiment, const std::vector<Case>& cases, const Json& metadata,
                       const std::map<std::string, std::string>& options, std::vector<std::string> columns)
    : experiment_(experiment), cases_(cases), columns_(std::move(columns)) {
  const ExperimentOptions& chosen = experiment.options();
  if (!chosen.part.empty()) part_ = parse_part("--part", chosen.part);
  if (!chosen.missing_parts.empty()) asked_for_ = parse_part("--missing-parts", "1/" + chosen.missing_parts).of;
  if (experiment.card().rows == RowUse::curves) identity_ = identity_of(experiment.card(), cases, metadata, options);
}

std::vector<std::size_t> PartsOfRun::groups() const { return groups_of(cases_, respects_of_parts(experiment_)); }

std::vector<bool> PartsOfRun::own_cases() const {
  std::vector<bool> own(cases_.size(), true);
  if (!part_) return own;
  const std::vector<std::size_t> part_of = dealt_out(cases_, groups(), part_->of);
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = part_of[i] == part_->number;
  return own;
}

std::filesystem::path PartsOfRun::file_of(const Part& part) const {
  const ExperimentOptions& options = experiment_.card().options;
  return folder_of_parts(options.out / options.name) / part.file_name();
}

bool PartsOfRun::is_there(const Part& part) const {
  std::error_code none;
  if (!std::filesystem::exists(file_of(part), none)) return false;
  try {
    const PartFile file = read_part(file_of(part));
    return file.description.at("part") == part.in_words() && file.description.at("identity") == identity_;
  } catch (const Error&) {
    return false;  // damaged
  }
}

void PartsOfRun::write(const RowsOfCases& rows, const Json& metadata) const {
  write_part(file_with(file(), part_.value_or(Part()), rows, metadata));
}

void PartsOfRun::save(const std::filesystem::path& file, const RowsOfCases& rows, const Json& metadata) const {
  write_part(file_with(file, Part(), rows, metadata));
}

RowsOfCases PartsOfRun::resume(const std::filesystem::path& file) const {
  RowsOfCases rows(cases_.size());
  std::error_code none;  // a missing file means that there is no run to resume
  if (!std::filesystem::is_regular_file(file, none)) return rows;
  try {
    const PartFile part = read_part(file);
    if (part.description.at("identity") != identity_) return rows;
    take_rows(part, rows);
    if (experiment_.indirect() != nullptr)
      experiment_.indirect()->add_findings(JsonPlace(part.description, file.string()).at("findings"));
  } catch (const Error&) {
    return RowsOfCases(cases_.size());  // damaged
  }
  const auto is_finished = [](const std::optional<Row>& row) {
    return row && row->text("status") != name_of(Status::interrupted);
  };
  const std::vector<std::size_t> groups = groups_of(cases_, respects_of(experiment_));
  std::vector<bool> is_whole(cases_.size(), true);  // by the first case of a group
  for (std::size_t i = 0; i < rows.size(); ++i) is_whole[groups[i]] = is_whole[groups[i]] && is_finished(rows[i]);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!is_whole[groups[i]]) rows[i].reset();
  }
  return rows;
}

PartFile PartsOfRun::file_with(const std::filesystem::path& path, const Part& part, const RowsOfCases& rows,
                               const Json& metadata) const {
  Table table(columns_of_part());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::optional<Row>& measured = rows[i];
    if (!measured) continue;
    Row row = *measured;
    row.set(case_column, i + 1);
    table.append(std::move(row));
  }
  const Json description{{"part", part.in_words()},
                         {"commit", metadata.at("commit")},
                         {"identity", identity_},
                         {"rows", table.rows().size()},
                         {"command_line", metadata.at("command_line")},
                         {"utc_time", metadata.at("utc_time")},
                         {"machine", machine_of(metadata)},
                         {"findings", experiment_.indirect() ? experiment_.indirect()->findings() : Json()}};
  return {.path = path, .description = description, .table = table.csv()};
}

std::vector<std::size_t> PartsOfRun::missing() const {
  std::vector<std::size_t> numbers;
  for (std::size_t number = 1; number <= asked_for_; ++number) {
    if (!is_there({number, asked_for_})) numbers.push_back(number);
  }
  return numbers;
}

std::vector<std::string> PartsOfRun::columns_of_part() const {
  std::vector<std::string> columns{case_column};
  columns.insert(columns.end(), columns_.begin(), columns_.end());
  return columns;
}

void PartsOfRun::take_rows(const PartFile& file, RowsOfCases& rows) const {
  const Table table = table_in(file.table, file.path);
  if (table.columns() != columns_of_part()) {
    throw Error(fmt::format("{} has other columns than this run writes; remove it and run that part again",
                            file.path.string()));
  }
  for (const Row& row : table.rows()) {
    require_measured(row, columns_, file.path);
    const std::size_t number = parsed<std::size_t>(row.text(case_column)).value_or(0);
    if (number < 1 || number > rows.size() || rows[number - 1]) {
      throw Error(
          fmt::format("{} has a row of case {}, which is not its own", file.path.string(), row.text(case_column)));
    }
    rows[number - 1] = row;
  }
}

RowsOfCases PartsOfRun::join(Json& metadata) const {
  const ExperimentOptions& options = experiment_.card().options;
  const std::vector<PartFile> files = read_all_parts({options.join.begin(), options.join.end()}, options.name);
  require_same_run(fmt::format("{} is of another run than this", files.front().path.string()),
                   files.front().description, {{"commit", metadata.at("commit")}, {"identity", identity_}});
  RowsOfCases rows(cases_.size());
  for (const PartFile& file : files) {
    take_rows(file, rows);
    const JsonPlace description(file.description, file.path.string());
    if (experiment_.indirect() != nullptr) experiment_.indirect()->add_findings(description.at("findings"));
  }
  const auto lost = std::ranges::find(rows, false, &std::optional<Row>::has_value);
  if (lost != rows.end())
    throw Error(fmt::format("no part has a row of {}", cases_[static_cast<std::size_t>(lost - rows.begin())].label()));
  describe_parts(files, metadata);
  forget_joining(metadata.at("command_line"));
  return rows;
}

}  // namespace dmocbench
