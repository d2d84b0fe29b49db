#include <algorithm>
#include <array>
#include <ctime>
#include <iomanip>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/report/model.hpp"
#include "bench/report/words.hpp"
#include "methods/program/status.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// "momentum" of "two_link_manipulator_momentum": the name without the longest problem that it begins with.
std::string kind_of(const std::string& figure) {
  std::size_t length = 0;
  for (const std::string& problem : problem_names()) {
    if (figure.starts_with(problem + "_")) length = std::max(length, problem.size() + 1);
  }
  return figure.substr(length);
}

/// The section of the paper whose claims name a figure as evidence; empty if no claim of the paper does.
std::string paper_section_of(const std::string& figure, const std::vector<Json>& claims) {
  for (const Json& claim : claims) {
    const auto figures = claim.at("figures").get<std::vector<std::string>>();
    if (claim.at("whose") == "paper" && std::ranges::count(figures, figure) > 0) return section_of(claim);
  }
  return "";
}

/// The different values of a key in the metadata of all runs, as text.
std::set<std::string> values_in_runs(const ResultsFolder& results, const std::string& key) {
  std::set<std::string> values;
  for (const ReportedRun& run : results.runs) {
    if (!run.metadata.contains(key)) continue;
    const Json& value = run.metadata.at(key);
    values.insert(value.is_string() ? value.get<std::string>() : value.dump());
  }
  return values;
}

/// The different fields of a column in the tables with a row per solve.
std::set<std::string> fields_of(const ResultsFolder& results, const std::string& column) {
  std::set<std::string> fields;
  for (const ReportedTable& table : results.tables) {
    const Json* const metadata = results.metadata_of(table.run);
    if (metadata == nullptr || table.file != table.run + ".csv" || !metadata->contains("cost_scale")) continue;
    for (const Row& row : table.table.rows()) fields.insert(row.text(column));
  }
  fields.erase("");
  return fields;
}

/// A number in a run's metadata; 0 if it is missing.
long long count_of(const ReportedRun& run, const std::string& key) {
  const Json count = run.metadata.value(key, Json());
  return count.is_number_integer() ? count.get<long long>() : 0;
}

/// Seconds since 1970 of "2026-11-23T14:22:57Z"; empty if the text has another form.
std::optional<double> seconds_of(const std::string& utc_time) {
  std::tm time{};
  std::istringstream text(utc_time);
  text >> std::get_time(&time, "%Y-%m-%dT%H:%M:%SZ");
  if (text.fail()) return std::nullopt;
  return static_cast<double>(::timegm(&time));
}

/// "12.3 minutes" from the begin of the first run to the end of the last; empty if a time is missing.
std::string duration_in_words(const ResultsFolder& results) {
  std::optional<double> first;
  std::optional<double> last;
  for (const ReportedRun& run : results.runs) {
    const Json wall = run.metadata.value("wall_seconds", Json());
    const auto begin = seconds_of(run.metadata.value("utc_time", ""));
    if (!begin || !wall.is_number()) return "";
    first = std::min(first.value_or(*begin), *begin);
    last = std::max(last.value_or(*begin), *begin + wall.get<double>());
  }
  if (!first) return "";
  constexpr double minute = 60.0;
  const double seconds = *last - *first;
  return seconds < 2.0 * minute ? fmt::format("{:.1f} s", seconds) : fmt::format("{:.1f} minutes", seconds / minute);
}

/// The place of a quantity among the orders of a line: orders of the solution precede all others.
std::size_t rank_of(const std::string& quantity) {
  constexpr std::array<std::string_view, 4> first{"state", "control", "costate", "objective"};
  return static_cast<std::size_t>(std::ranges::find(first, quantity) - first.begin());
}

/// The smallest rank of a line's orders; above all others without orders.
std::size_t rank_of_line(const Json& line) {
  std::size_t rank = std::numeric_limits<std::size_t>::max();
  for (const Json& order : line.at("orders")) rank = std::min(rank, order.at("rank").get<std::size_t>());
  return rank;
}

/// A fitted order as "state 2.01 ± 0.02", "state 2.01" where two grids give no error, "costate: floor" without a fit.
std::string order_in_words(const Row& row) {
  const std::string quantity = in_words(row.text("quantity"));
  const auto slope = row.number("slope");
  const auto error = row.number("standard_error");
  if (!slope) return fmt::format("{}: {}", quantity, row.text("verdict").empty() ? "no order" : row.text("verdict"));
  return fmt::format("{} {:.3f}{}", quantity, *slope, error ? fmt::format(" ± {:.2g}", *error) : "");
}

}  // namespace

std::string command_of(const Json* metadata) {
  if (metadata == nullptr) return "";
  auto words = metadata->at("command_line").get<std::vector<std::string>>();
  std::ranges::transform(words, words.begin(), without_folders);
  return fmt::format("{}", fmt::join(words, " "));
}

bool is_unsolved(const Row& row) { return !is_solved(status_named(row.text("status"))); }

bool has_columns(const Table& table, std::initializer_list<std::string_view> names) {
  return std::ranges::all_of(names,
                             [&](std::string_view name) { return std::ranges::count(table.columns(), name) > 0; });
}

PageModel figures_model(const ResultsFolder& results, const std::string& folder) {
  std::map<bool, std::map<std::string, Json>> groups;  // the paper's sections, then kinds
  for (const ReportedFigure& figure : results.figures) {
    const std::string section = paper_section_of(figure.name, results.claims);
    Json& kind = groups[section.empty()][section.empty() ? in_words(kind_of(figure.name)) : section];
    kind.push_back({{"figure", figure.name},
                    {"words", in_words(figure.name)},
                    {"file", link_to_file(folder + "figures/" + figure.name + ".svg")}});
  }
  Json model = Json::array();
  for (const auto& [is_other, kinds] : groups) {
    Json group{{"of_paper", !is_other}, {"kinds", Json::array()}};
    for (const auto& [kind, figures] : kinds) group["kinds"].push_back({{"kind", kind}, {"figures", figures}});
    model.push_back(std::move(group));
  }
  return model;
}

PageModel tables_model(const ResultsFolder& results, const std::string& folder) {
  std::map<std::string, Json> by_run;
  for (const ReportedTable& reported : results.tables) {
    const Table& table = reported.table;
    const Json* const metadata = results.metadata_of(reported.run);
    const auto rows_with = [&](const auto& wanted) {
      return has_columns(table, {"status"}) ? std::ranges::count_if(table.rows(), wanted) : 0;
    };
    const auto coarse =
        rows_with([](const Row& row) { return is_no_motion(status_named(row.text("status"))); });  // these are solved
    const auto unsolved = rows_with(is_unsolved) - coarse;
    by_run[reported.run].push_back({{"table", reported.file},
                                    {"file", link_to_file(folder + reported.file)},
                                    {"rows", counted(table.rows().size(), "row")},
                                    {"columns", counted(table.columns().size(), "column")},
                                    {"unsolved", unsolved > 0 ? Json(unsolved) : Json()},
                                    {"coarse", coarse > 0 ? Json(coarse) : Json()},
                                    {"cut", table.rows().size() > most_rows ? Json(most_rows) : Json()},
                                    {"command", command_of(metadata)}});
  }
  Json model = Json::array();
  for (const auto& [run, tables] : by_run)
    model.push_back({{"run", in_words(run)}, {"count", tables.size()}, {"tables", tables}});
  return model;
}

PageModel table_json(const ReportedTable& reported, const Json* metadata) {
  Json columns = Json::array();
  for (const std::string& column : reported.table.columns()) {
    const Json::json_pointer schema =
        Json::json_pointer() / "tables" / reported.file / "schema" / "properties" / column;
    const auto stated = [&](const char* fact) {
      const Json::json_pointer place = schema / fact;
      const bool is_there = metadata != nullptr && metadata->contains(place) && metadata->at(place).is_string();
      return is_there ? metadata->at(place) : Json("");
    };
    columns.push_back({{"name", column}, {"unit", stated("unit")}, {"meaning", stated("description")}});
  }
  Json rows = Json::array();
  for (const Row& row : reported.table.rows()) {
    if (rows.size() == most_rows) break;
    Json fields = Json::array();
    for (const std::string& column : reported.table.columns()) fields.push_back(row.text(column));
    rows.push_back(std::move(fields));
  }
  return {{"columns", columns}, {"rows", rows}};
}

PageModel run_model(const ResultsFolder& results) {
  Json model{{"warnings", results.faults}, {"unsolved", Json::array()}, {"facts", Json::array()}};
  for (const ReportedRun& run : results.runs) {
    if (!run.metadata.value("complete", true))
      model["warnings"].push_back(fmt::format("The run {} is not complete.", run.name));
    const auto [failed, coarse, violating] =
        std::tuple(count_of(run, "not_solved"), count_of(run, "too_coarse"), count_of(run, "violates_between_stages"));
    if (failed + coarse + violating == 0) continue;
    model["unsolved"].push_back({{"run", run.name},
                                 {"rows", count_of(run, "rows")},
                                 {"failed", failed},
                                 {"coarse", coarse},
                                 {"violating", violating}});
  }
  std::size_t rows = 0;
  for (const ReportedTable& table : results.tables) rows += table.table.rows().size();
  model["rows"] = rows;
  const auto add = [&model](const char* term, const std::set<std::string>& values, const std::string& more = "") {
    const std::string text = fmt::format("{}{}", fmt::join(values, ", "), more);
    if (!text.empty()) model["facts"].push_back({{"term", term}, {"text", text}});
  };
  const std::set<std::string> times = values_in_runs(results, "utc_time");
  if (!times.empty()) {
    const std::string duration = duration_in_words(results);
    add("First run began", {*times.begin()},
        duration.empty() ? "" : fmt::format("; the last run ended {} later", duration));
  }
  for (const auto& [term, key] :
       {std::pair("Commit", "commit"), std::pair("Processor", "processor"), std::pair("Cores", "cores"),
        std::pair("Instructions", "instruction_set"), std::pair("System", "operating_system"),
        std::pair("Compiler", "compiler"), std::pair("Flags", "flags")})
    add(term, values_in_runs(results, key));
  std::set<std::string> methods;  // families, without the integrators and points of their methods
  for (const std::string& method : fields_of(results, "method")) {
    const std::string words = method_in_words(method);
    methods.insert(words.substr(0, words.find(',')));
  }
  add("Methods", methods);
  add("Problems", fields_of(results, "problem"));
  return model;
}

PageModel measured_model(const ResultsFolder& results) {
  std::map<std::array<std::string, 4>, Json> lines;  // by problem, method, tableau and stages
  for (const auto& [file, run, table] : results.tables) {
    // Tables of fits by situation have several orders of a method.
    const bool has_orders = file == run + "_slopes.csv" && !has_columns(table, {"situation"}) &&
                            has_columns(table, {"problem", "method", "quantity", "slope", "standard_error"});
    const bool has_solves = file == run + ".csv" && has_columns(table, {"problem", "method", "status"});
    for (const Row& row : table.rows()) {
      if (!has_orders && !has_solves) break;
      Json& line = lines[{row.text("problem"), row.text("method"), row.text("tableau"), row.text("stages")}];
      if (line.is_null()) {
        line = {{"problem", in_words(row.text("problem"))},
                {"method", method_in_words(row.text("method"))},
                {"tableau", row.text("tableau")},
                {"stages", row.text("stages") + (row.text("stages") == "1" ? " stage" : " stages")},
                {"orders", Json::array()},
                {"rows", 0},
                {"solved", 0},
                {"finest", 0.0},
                {"cost", ""}};
      }
      if (has_orders)
        line["orders"].push_back(
            {{"table", file}, {"text", order_in_words(row)}, {"rank", rank_of(row.text("quantity"))}});
      if (!has_solves) continue;
      line["rows"] = line["rows"].get<int>() + 1;
      if (is_unsolved(row)) continue;
      line["solved"] = line["solved"].get<int>() + 1;
      const double intervals = row.number("intervals", 0.0);
      const auto cost = row.number("objective");
      if (!cost || intervals < line["finest"].get<double>()) continue;
      line["finest"] = intervals;
      line["cost"] = fmt::format("{:.9g} with N = {:g}", *cost, intervals);
    }
  }
  Json model = Json::array();
  for (auto& [scheme, line] : lines) {
    line["solves"] = line["rows"] > 0 ? fmt::format("{} of {}", line["solved"].dump(), line["rows"].dump()) : "";
    std::ranges::stable_sort(line["orders"].get_ref<Json::array_t&>(), {},
                             [](const Json& order) { return order.at("rank").get<std::size_t>(); });
    for (Json& order : line["orders"]) order["comma"] = &order == &line["orders"].front() ? "" : ", ";
    model.push_back(std::move(line));
  }
  std::ranges::stable_sort(model.get_ref<Json::array_t&>(), {}, rank_of_line);
  return model;
}

}  // namespace dmocbench
