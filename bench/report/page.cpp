#include "bench/report/page.hpp"

#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "bench/report/page_parts.hpp"
#include "bench/report/sections.hpp"

namespace dmocbench {

std::string report_page(const ResultsFolder& results, const std::string& folder) {
  const std::array<std::pair<std::string_view, std::string>, 5> sections{{{"Overview", overview_section(results)},
                                                                          {"Claims", claims_section(results)},
                                                                          {"Motions", motions_section(results)},
                                                                          {"Figures", figures_section(results)},
                                                                          {"Tables", tables_section(results, folder)}}};
  std::string navigation;
  std::string content;
  for (const auto& [title, section] : sections) {
    if (section.empty()) continue;
    std::string id(title);
    id.front() = static_cast<char>(id.front() - 'A' + 'a');
    navigation += fmt::format("<a href=\"#{}\">{}</a>\n", id, title);
    content += section;
  }
  // Nothing is fetched from anywhere, whatever a table holds.
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"default-src "
      "'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n<title>DMOC against collocation</title>\n"
      "<style>\n{}</style></head>\n<body><nav>{}</nav>\n<main>\n{}</main>\n<script>\n{}</script></body></html>\n",
      style_of_page, navigation, content, script_of_page);
}

}  // namespace dmocbench
