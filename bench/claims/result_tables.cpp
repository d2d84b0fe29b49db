// Which tables claims are judged by, what these have to look like, and whether the run that wrote them came to its end.
#include "bench/claims/result_tables.hpp"

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include "bench/run/part_file.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/written_tables.hpp"

namespace dmocbench {

namespace {

ColumnNames columns(ColumnNames first, const ColumnNames& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

const ColumnNames solve{"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals"};
const ColumnNames status{"status", "branch"};
const ColumnNames fit{"problem", "method", "tableau", "stages", "quantity"};
const ColumnNames scheme{"problem", "method", "tableau", "stages"};

/// Columns of keys that count or measure something.
bool is_number(const std::string& column) {
  constexpr std::array numbers{
      "stages",    "intervals", "order", "steps",       "steps_per_period",     "periods",     "h", "minimum",
      "tolerance", "error",     "step",  "revolutions", "steps_per_revolution", "eccentricity"};
  return std::ranges::find(numbers, column) != numbers.end();
}

/// Throws `Error` unless the table has its columns, each once, and every row a key of its own.
void check(const Table& table, const DeclaredTable& declared) {
  for (const std::string& column : columns(declared.key, declared.texts)) {
    const auto count = std::ranges::count(table.columns(), column);
    if (count == 1) continue;
    throw Error(fmt::format("{}.csv has {} column {}", declared.name, count == 0 ? "no" : "more than one", column));
  }
  std::map<std::vector<std::string>, const Row*> seen;
  for (const Row& row : table.rows()) {
    std::vector<std::string> key;
    for (const std::string& column : declared.key) {
      if (is_number(column)) static_cast<void>(row.needed(column));
      key.push_back(row.text(column));
    }
    const auto [first, is_new] = seen.try_emplace(key, &row);
    if (!is_new)
      throw Error(fmt::format("{} has the key of {}: {}", row.place(), first->second->place(), fmt::join(key, ", ")));
  }
}

/// Reads a regular file; pipes are refused because they could block.
std::string content_of(const std::filesystem::path& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown))
    throw Error(fmt::format("{} is no regular file", path.filename().string()));
  return read_file(path);
}

/// Throws `Error` if there are parts of a run instead of its table.
void refuse_parts(const std::filesystem::path& folder, const std::string& run, const std::string& table) {
  if (std::error_code unknown; !std::filesystem::exists(folder_of_parts(folder / run), unknown)) return;
  throw Error(fmt::format("{} is not there, but parts of it are: merge --name {} joins them", table, run));
}

/// Throws `Error` unless a run came to its end with all its cases, and wrote the table with this content.
void check_run(const std::filesystem::path& folder, const std::string& run, const std::string& table,
               std::string_view content) {
  const std::string file = run + ".json";
  if (std::error_code unknown; !std::filesystem::exists(folder / file, unknown)) {
    throw Error(fmt::format("there is no {}, which tells whether the run came to its end", file));
  }
  const auto description = nlohmann::json::parse(content_of(folder / file), nullptr, false);
  const auto complete = description.is_object() ? description.find("complete") : description.end();
  if (!description.is_object() || complete == description.end() || !complete->is_boolean()) {
    throw Error(fmt::format("{} does not tell whether the run came to its end", file));
  }
  if (!complete->get<bool>()) throw Error(fmt::format("the run was interrupted, as {} says; run it again", file));
  if (description.contains("cases") && description["cases"] != description.value("rows", nlohmann::json())) {
    throw Error(fmt::format("{} tells of {} cases, not all of which have a row; run it again", file,
                            description["cases"].dump()));
  }
  try {
    require_as_written(description, file, table, content);
  } catch (const Error& error) {
    throw Error(fmt::format("{}; run it again", error.what()));
  }
}

/// The tables of the core, and those that were declared later.
std::vector<DeclaredTable>& all_tables() {
  static std::vector<DeclaredTable> tables{
      {"consistency", "consistency", columns(solve, {"tolerance"}), status},
      {"consistency_tolerances", "consistency_tolerances", columns(solve, {"tolerance"}), status},
      {"objective", "objective", solve, status},
      {"convergence", "convergence", solve, status},
      {"convergence_512", "convergence_512", solve, status},
      {"convergence_indirect", "convergence_indirect", solve, status},
      {"convergence_slopes", "convergence", fit},
      {"convergence_512_slopes", "convergence_512", fit},
      {"convergence_indirect_slopes", "convergence_indirect", fit, {"verdict"}},
      {"equivalence", "equivalence", solve, status},
      {"equivalence_slopes", "equivalence", fit, {"verdict"}},
      {"convergence_stages", "convergence_stages", solve, status},
      {"convergence_equal_accuracy", "convergence", {"problem", "method", "tableau", "stages", "quantity", "error"}},
      {"convergence_indirect_reference", "convergence_indirect", {"problem"}},
      {"iterations", "iterations", columns(solve, {"crash"}), status},
      {"iterations_tolerances", "iterations_tolerances", columns(solve, {"crash", "tolerance"}), status},
      {"iterations_limited_memory", "iterations_limited_memory", columns(solve, {"crash"}), status},
      {"iterations_bounds", "iterations_bounds", columns(solve, {"crash"}), status},
      {"iterations_common", "iterations_common", columns(solve, {"crash"}), status},
      {"derivatives", "derivatives", columns(solve, {"hessian", "tolerance"}), status},
      {"derivatives_cold", "derivatives_cold", columns(solve, {"hessian", "tolerance"}), status},
      {"consistency_order_slopes", "consistency_order", {"problem", "tableau", "stages", "order", "quantity"}},
      {"structure_momentum", "structure", columns(scheme, {"force", "steps", "h"})},
      {"structure_symplecticity", "structure", columns(scheme, {"h"})},
      {"structure_energy_behaviour", "structure", columns(scheme, {"order", "steps_per_period", "periods"})},
      {"structure_modified_energy_slopes", "structure", fit},
      {"structure_energy_work", "structure", columns(scheme, {"intervals"})},
      {"structure_energy_work_slopes", "structure", fit},
      {"structure_orthogonal_forces", "structure", columns(scheme, {"intervals"})},
      {"structure_rotations", "structure", columns(scheme, {"axis"}), {"action"}},
      {"consistency_order_transforms", "consistency_order", {"problem", "h"}},
      {"smoothness_slopes", "smoothness", {"situation", "method", "tableau", "stages", "quantity"}, {"active", "end"}},
      {"coercivity", "coercivity", columns(scheme, {"intervals"}), {"status"}},
      {"structure_advantage_ratios", "structure_advantage",
       columns(scheme, {"solver", "factorisation", "intervals", "quantity"})},
      {"local_minima_minima",
       "local_minima",
       {"problem", "tableau", "stages", "solver", "derivatives", "intervals", "minimum"},
       {"is_motion"}},
      {"local_minima_shares", "local_minima", solve},
      {"cold_start_shares", "cold_start", solve},
      {"sequence", "sequence", columns(scheme, {"intervals", "sequence", "step"}), {"status"}},
      {"adaptive", "adaptive", columns(scheme, {"grid"}), {"status"}},
      {"adaptive_effectivity", "adaptive", columns(scheme, {"grid", "intervals", "quantity"}), {"status", "verdict"}},
      {"profile", "profile", solve, {"status", "success"}},
      {"slips", "slips", {"problem", "slip"}},
      {"shooting", "shooting", columns(scheme, {"intervals"}), {"status"}},
      {"convergence_shooting_slopes", "convergence_shooting", fit, {"verdict"}},
      {"convergence_shooting_two_stages_slopes", "convergence_shooting_two_stages", fit, {"verdict"}},
      {"cold_start_shooting_shares", "cold_start_shooting", solve},
      {"structure_advantage_shooting", "structure_advantage_shooting", columns(solve, {"factorisation"}), status},
  };
  return tables;
}

}  // namespace

const std::vector<DeclaredTable>& declared_tables() { return all_tables(); }

void declare_table(DeclaredTable table) { all_tables().push_back(std::move(table)); }

ResultTables ResultTables::read(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) throw Error(fmt::format("there is no folder {}", folder.string()));
  ResultTables tables;
  for (const DeclaredTable& declared : declared_tables()) tables.read_table(folder, declared);
  if (tables.tables_.empty() && tables.faults_.empty()) {
    throw Error(fmt::format("there is no table that a claim reads in {0}; run an experiment with --out {0} first",
                            folder.string()));
  }
  return tables;
}

void ResultTables::read_table(const std::filesystem::path& folder, const DeclaredTable& declared) {
  tables_.erase(declared.name);
  faults_.erase(declared.name);
  const std::string file = declared.name + ".csv";
  try {
    if (std::error_code unknown; !std::filesystem::exists(folder / file, unknown)) {
      return refuse_parts(folder, declared.run, file);
    }
    const std::string content = content_of(folder / file);
    add(declared.name, Table::from_csv(content));
    check(tables_.at(declared.name), declared);
    check_run(folder, declared.run, file, content);
  } catch (const Error& error) {
    const std::string sentence = error.what();
    const bool names_it = sentence.find(file) != std::string::npos;
    faults_[declared.name] = names_it ? sentence : fmt::format("{}: {}", file, sentence);
  }
}

void ResultTables::add(const std::string& name, Table table) {
  table.name_places(name + ".csv");
  tables_[name] = std::move(table);
}

Selection ResultTables::rows(std::string_view table) const {
  if (const auto fault = faults_.find(table); fault != faults_.end()) throw Error(fault->second);
  const auto found = tables_.find(table);
  if (found == tables_.end()) throw MissingTable(fmt::format("there is no {}.csv", table));
  return found->second;
}

Selection ResultTables::rows(std::string_view table, std::string_view problem) const {
  Selection of_problem = rows(table).where("problem", problem);
  if (of_problem.empty()) throw Error(fmt::format("{}.csv has no row of {}", table, problem));
  return of_problem;
}

}  // namespace dmocbench
