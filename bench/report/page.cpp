#include "bench/report/page.hpp"

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <kainjow/mustache.hpp>
#include <zlib.h>

#include "bench/report/model.hpp"
#include "bench/report/words.hpp"
#include "bench/run/embedded_file.hpp"
#include "bench/run/json_place.hpp"
#include "methods/error.hpp"
#include "methods/runtime/numbers_in_text.hpp"

DMOCBENCH_EMBEDDED_FILE(page, "plots/report/page.mustache");
DMOCBENCH_EMBEDDED_FILE(first_screen, "plots/report/first_screen.mustache");
DMOCBENCH_EMBEDDED_FILE(small_picture, "plots/report/small_picture.mustache");
DMOCBENCH_EMBEDDED_FILE(claims, "plots/report/claims.mustache");
DMOCBENCH_EMBEDDED_FILE(claim, "plots/report/claim.mustache");
DMOCBENCH_EMBEDDED_FILE(problems, "plots/report/problems.mustache");
DMOCBENCH_EMBEDDED_FILE(motion, "plots/report/motion.mustache");
DMOCBENCH_EMBEDDED_FILE(figures, "plots/report/figures.mustache");
DMOCBENCH_EMBEDDED_FILE(tables, "plots/report/tables.mustache");
DMOCBENCH_EMBEDDED_FILE(style, "plots/report/report.css");
DMOCBENCH_EMBEDDED_FILE(script, "plots/report/report.js");

namespace dmocbench {

namespace {

namespace mustache = kainjow::mustache;
using Json = nlohmann::ordered_json;

/// Templates within the page by the names by which they read each other; names of values differ from these.
constexpr std::array<std::pair<const char*, const char*>, 8> templates{
    {{"first_screen_part", dmocbench_file_first_screen},
     {"small_picture_part", dmocbench_file_small_picture},
     {"claims_part", dmocbench_file_claims},
     {"claim_part", dmocbench_file_claim},
     {"problems_part", dmocbench_file_problems},
     {"motion_part", dmocbench_file_motion},
     {"figures_part", dmocbench_file_figures},
     {"tables_part", dmocbench_file_tables}}};

/// Values for templates, in which an empty text opens no section. A list `x` has a value `has_x`: its section is
/// repeated.
mustache::data data_of(const Json& json) {
  if (json.is_object()) {
    mustache::data object = mustache::data::type::object;
    for (const auto& [key, value] : json.items()) {
      object.set(key, data_of(value));
      if (value.is_array()) object.set("has_" + key, !value.empty());
    }
    return object;
  }
  if (json.is_array()) {
    mustache::data list = mustache::data::type::list;
    for (const Json& value : json) list.push_back(data_of(value));
    return list;
  }
  if (json.is_boolean()) return json.get<bool>();
  const std::string text = json.is_null() ? "" : json.is_string() ? json.get<std::string>() : json.dump();
  if (text.empty()) return false;
  return text;
}

/// A text in zlib's format, in the letters of base64.
std::string packed(const std::string& text) {
  std::vector<Bytef> bytes(::compressBound(text.size()));
  uLongf size = bytes.size();
  const std::vector<Bytef> source(text.begin(), text.end());
  if (::compress2(bytes.data(), &size, source.data(), source.size(), Z_BEST_COMPRESSION) != Z_OK)
    throw Error("there is not enough memory to compress the tables of the report");
  return base64(std::string(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)));
}

/// JSON in valid UTF-8, whatever bytes names and tables have.
std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Figures and tables, packed, by the names by which the script unpacks them.
mustache::data blobs_of(const ResultsFolder& results) {
  mustache::data blobs = mustache::data::type::list;
  const auto add = [&blobs](const std::string& name, const std::string& text) {
    mustache::data blob;
    blob.set("blob", name);
    blob.set("data", packed(text));
    blobs.push_back(blob);
  };
  for (const ReportedFigure& figure : results.figures) add("figure-" + figure.name, figure.svg);
  for (const ReportedTable& table : results.tables)
    add("table-" + table.file, dumped(table_json(table, results.metadata_of(table.run))));
  return blobs;
}

/// The digest by which the page allows its own script and no other, in base64. The build knows it in hexadecimal
/// digits.
std::string digest_of_script() {
  constexpr std::string_view digits = DMOCBENCH_PAGE_DIGEST;
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
  return base64(bytes);
}

}  // namespace

std::string report_page(const ResultsFolder& results, const std::string& folder) {
  const Json answers = results.claims.empty() ? Json::array() : answers_model(results);
  const Json model{{"claims", claims_model(results)},
                   {"answers", answers},
                   {"heads", answers.empty() ? Json::array() : answers.front().at("cells")},
                   {"measured", results.claims.empty() ? measured_model(results) : Json()},
                   {"recommendations", results.claims.empty() ? recommendations_model(results) : Json()},
                   {"gallery", gallery_model(results)},
                   {"figures", figures_model(results, folder)},
                   {"figure_count", counted(results.figures.size(), "figure")},
                   {"tables", tables_model(results, folder)},
                   {"table_count", counted(results.tables.size(), "table")},
                   {"folder", folder},
                   {"run", run_model(results)}};
  mustache::data page = data_of(json_in(dumped(model), "the report"));
  page.set("blobs", blobs_of(results));
  page.set("style", dmocbench_file_style);
  page.set("script", dmocbench_file_script);
  page.set("digest", digest_of_script());
  for (const auto& [name, text] : templates)
    page.set(name, mustache::data{mustache::partial{[text = text] { return std::string(text); }}});
  mustache::mustache form{std::string(dmocbench_file_page)};
  return form.render(page);
}

}  // namespace dmocbench
