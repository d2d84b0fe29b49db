#include "bench/report/page.hpp"

#include <fmt/format.h>

#include "bench/report/html.hpp"
#include "bench/report/page_parts.hpp"
#include "bench/report/sections.hpp"

namespace dmocbench {

std::string report_page(const ResultsFolder& results, const std::string& folder) {
  return page_of("DMOC against collocation", {{"Overview", overview_section(results)},
                                              {"Claims", claims_section(results)},
                                              {"Gallery", gallery_section(results)},
                                              {"Figures", figures_section(results)},
                                              {"Tables", tables_section(results, folder)}});
}

std::string page_of(const std::string& title, const std::vector<std::pair<std::string, std::string>>& sections) {
  std::string navigation;
  std::string content;
  for (const auto& [name, section] : sections) {
    if (section.empty()) continue;
    std::string id = name;
    id.front() = static_cast<char>(id.front() - 'A' + 'a');
    navigation += fmt::format("<a href=\"#{}\">{}</a>\n", id, escaped(name));
    content += section;
  }
  // The page fetches no files and runs only its own script, regardless of the content of tables and figures. Browsers
  // hash the whole text between the tags of the script.
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'sha256-{}'\">\n"
      "<title>{}</title>\n<style>\n{}</style></head>\n<body><nav aria-label=\"sections\">{}</nav>\n"
      "<main>\n{}</main>\n<script>{}</script></body></html>\n",
      base64(digest_of_script), escaped(title), style_of_page, navigation, content, script_of_page);
}

}  // namespace dmocbench
