#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claim.hpp"
#include "bench/claims/claims_table.hpp"
#include "bench/claims/result_tables.hpp"
#include "bench/report/model.hpp"
#include "bench/report/words.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

std::string text(const Json& claim, const char* key) { return claim.at(key).get<std::string>(); }

const ReportedTable* table_named(const ResultsFolder& results, const std::string& file) {
  const auto found = std::ranges::find(results.tables, file, &ReportedTable::file);
  return found == results.tables.end() ? nullptr : &*found;
}

/// Links to what the page shows of the evidence: a table with the rows and columns by which the claim was judged, a
/// figure, or a file that is not there.
Json evidence_of(const Json& claim, const ResultsFolder& results) {
  Json links = Json::array();
  std::set<std::string> linked;
  const auto add_table = [&](const std::string& file, const Json& rows) {
    if (!linked.insert(file).second) return;
    std::vector<std::size_t> records;
    std::vector<std::string> columns;
    if (!rows.is_null()) {
      rows.at("records").get_to(records);
      rows.at("columns").get_to(columns);
    }
    links.push_back({{"in_table", file},
                     {"records", packed_ranges(records)},
                     {"columns", fmt::format("{}", fmt::join(columns, " "))}});
  };
  for (const Json& rows : claim.at("rows")) {
    if (table_named(results, text(rows, "table")) != nullptr) add_table(text(rows, "table"), rows);
  }
  for (const std::string& file : claim.at("evidence").get<std::vector<std::string>>()) {
    const std::string name = std::filesystem::path(file).stem().string();
    if (file == "figures/" + name + ".svg" && std::ranges::count(results.figures, name, &ReportedFigure::name) > 0) {
      links.push_back({{"in_figure", name}, {"words", in_words(name)}});
    } else if (table_named(results, file) != nullptr) {
      add_table(file, {});
    } else {
      links.push_back({{"not_there", file}});
    }
  }
  return links;
}

/// "build/bench/claims --out results" for "build/bench/convergence --out results ...", "dmocbench claims" for
/// "dmocbench convergence": the command that judges the tables of a run.
std::string command_that_judges(const Json& metadata) {
  auto words = metadata.at("command_line").get<std::vector<std::string>>();
  std::ranges::transform(words, words.begin(), without_folders);
  const std::string judge = words.front().substr(0, words.front().find_last_of("/ ") + 1) + "claims";
  const auto out = std::ranges::find(words, "--out");
  return words.end() - out < 2 ? judge : fmt::format("{} --out {}", judge, *(out + 1));
}

/// The commands of the runs that wrote the tables behind a claim, each once, and of the judgement.
std::vector<std::string> commands_of(const Json& evidence, const ResultsFolder& results) {
  std::vector<std::string> commands;
  std::string last;
  for (const Json& link : evidence) {
    const Json* const metadata =
        link.contains("in_table") ? results.metadata_of(table_named(results, text(link, "in_table"))->run) : nullptr;
    const std::string command = command_of(metadata);
    if (command.empty() || std::ranges::count(commands, command) > 0) continue;
    commands.push_back(command);
    if (last.empty()) last = command_that_judges(*metadata);
  }
  if (!last.empty()) commands.push_back(last);
  return commands;
}

/// One number for each method, where the first clause of the measurement states the same quantity of several.
Json values_of(const Json& claim) {
  Json values = Json::array();
  std::set<std::string> names;
  std::set<std::string> methods;
  for (const Json& number : claim.at("measured").empty() ? Json::array() : claim.at("measured").front().at("numbers")) {
    names.insert(text(number, "name"));
    methods.insert(text(number, "method"));
    values.push_back(
        {{"method", text(number, "method")}, {"text", fmt::format("{:.3g}", number.at("value").get<double>())}});
  }
  const bool is_of_each = names.size() == 1 && methods.size() == values.size() && values.size() > 1 &&
                          std::ranges::all_of(methods, [](const std::string& method) {
                            return method == "dmoc" || method == "hamiltonian" || method == "tangent";
                          });
  return is_of_each ? values : Json::array();
}

/// A claim on one problem.
Json item_of(Json claim, const ResultsFolder& results) {
  const Json evidence = evidence_of(claim, results);
  claim["problem_words"] = in_words(text(claim, "problem"));
  claim["verdict_words"] = verdict_in_words(text(claim, "verdict"), text(claim, "whose"));
  claim["first"] = claim.at("measured").empty() ? "" : text(claim.at("measured").front(), "text");
  claim["values"] = values_of(claim);
  claim["commands"] = commands_of(evidence, results);
  claim["evidence"] = evidence;
  return claim;
}

bool is_reproduced(const Json& entry) {
  return std::ranges::all_of(entry.at("items"), [](const Json& item) { return item.at("verdict") == "reproduced"; });
}

/// The claims with the same name and statement are one entry; opposite findings of one name stand together, and those
/// that are not reproduced come first.
Json entries_of(const std::vector<Json>& items) {
  std::vector<Json> entries;
  for (const Json& item : items) {
    const auto same = std::ranges::find_if(entries, [&item](const Json& entry) {
      return entry.at("name") == item.at("name") && entry.at("states") == item.at("states");
    });
    if (same != entries.end()) {
      (*same)["items"].push_back(item);
    } else {
      const auto last = std::find_if(entries.rbegin(), entries.rend(),
                                     [&item](const Json& entry) { return entry.at("name") == item.at("name"); });
      const Json entry{{"name", text(item, "name")},
                       {"name_words", in_words(text(item, "name"))},
                       {"claim", item.at("claim")},
                       {"states", item.at("states")},
                       {"items", {item}}};
      entries.insert(last == entries.rend() ? entries.end() : last.base(), entry);
    }
  }
  std::ranges::stable_partition(entries, std::not_fn(is_reproduced));
  return entries;
}

/// The first clause of why an entry is not reproduced: the reason, or the data that are missing.
Json reason_of(const Json& entry) {
  for (const Json& item : entry.at("items")) {
    if (item.at("verdict") == "reproduced") continue;
    if (item.at("verdict") == "not judged" || item.at("reasons").empty()) return item.at("first");
    return item.at("reasons").front().at("text");
  }
  return "";
}

/// How many items have which verdict, in the order of `all_verdicts`, then the others.
Json score_of(const std::vector<Json>& items) {
  std::vector<std::string> verdicts;
  for (const ClaimVerdict verdict : all_verdicts) verdicts.emplace_back(name_of(verdict));
  for (const Json& item : items) {
    if (std::ranges::count(verdicts, text(item, "verdict")) == 0) verdicts.push_back(text(item, "verdict"));
  }
  Json score = Json::array();
  for (const std::string& verdict : verdicts) {
    const auto count = std::ranges::count(items, verdict, [](const Json& item) { return text(item, "verdict"); });
    if (count == 0) continue;
    score.push_back({{"verdict", verdict}, {"count", count}});
    score.back()["words"] = verdict_in_words(verdict, text(items.front(), "whose"), static_cast<std::size_t>(count));
  }
  return score;
}

/// The titles of the paper's sections.
std::string title_of_section(const std::string& number) {
  static const std::map<std::string, const char*, std::less<>> titles{
      {"2.1", "Variational mechanics"},
      {"2.2", "Discrete mechanics"},
      {"2.3", "Discrete and continuous Lagrangian systems"},
      {"3.3", "Discrete and continuous optimal control"},
      {"3.4", "Correspondence with Runge-Kutta methods"},
      {"3.5", "Adjoint systems"},
      {"3.6", "Convergence"},
      {"4.1", "Implementation"},
      {"4.2.1", "Low-thrust orbital transfer"},
      {"4.2.2", "Two-link manipulator"}};
  const auto found = titles.find(number);
  return found == titles.end() ? "" : found->second;
}

/// The place of a claim on the page: the paper's by sections, then findings, misprints, extensions.
std::pair<std::size_t, std::string> group_of(const Json& claim) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> others{
      {{"ours", "Our findings"}, {"misprint", "Misprints"}, {"extension", "Extensions of the suite"}}};
  const std::string whose = text(claim, "whose");
  if (whose == "paper") return {0, section_of(claim)};
  const auto* const found = std::ranges::find(others, whose, [](const auto& other) { return other.first; });
  const auto place = static_cast<std::size_t>(found - others.begin());
  return {1 + place, found == others.end() ? in_words(whose) : std::string(found->second)};
}

}  // namespace

PageModel claims_model(const ResultsFolder& results) {
  if (results.claims.empty()) return {};
  std::map<std::pair<std::size_t, std::string>, std::vector<Json>> groups;
  std::vector<Json> statements;
  Json model{{"open", Json::array()}, {"groups", Json::array()}};
  for (const Json& claim : results.claims) {
    const Json item = item_of(claim, results);
    groups[group_of(claim)].push_back(item);
    if (text(claim, "whose") == "paper") statements.push_back(item);
  }
  for (const auto& [place, items] : groups) {
    const Json entries = entries_of(items);
    const bool is_of_paper = place.first == 0;
    for (const Json& entry : entries) {
      if (!is_of_paper || is_reproduced(entry)) continue;
      model["open"].push_back(entry);
      model["open"].back()["reason"] = reason_of(entry);
    }
    std::string id = place.second;
    std::ranges::replace(id, ' ', '-');
    const std::string number =
        place.second.substr(std::min(place.second.find_first_of("0123456789"), place.second.size()));
    model["groups"].push_back({{"title", place.second},
                               {"id", id},
                               {"number", number},
                               {"subject", title_of_section(number)},
                               {"of_paper", is_of_paper},
                               {"all", items.size()},
                               {"score", score_of(items)},
                               {"entries", entries}});
  }
  model["statements"] = statements.size();
  model["reproduced"] =
      std::ranges::count(statements, "reproduced", [](const Json& item) { return text(item, "verdict"); });
  model["score"] = score_of(statements);
  return model;
}

std::string section_of(const Json& claim) { return section_in(text(claim, "where")); }

}  // namespace dmocbench
