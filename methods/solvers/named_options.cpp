#include "methods/solvers/named_options.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// "a, b or c".
std::string listed(std::vector<std::string_view> words, std::string_view conjunction) {
  const std::string_view last = words.back();
  words.pop_back();
  return words.empty() ? std::string(last) : fmt::format("{} {} {}", fmt::join(words, ", "), conjunction, last);
}

}  // namespace

NamedOption named_option(std::string_view name, std::uint32_t& result) {
  return {.name = name, .takes = {"a whole number"}, .read = [&result](const std::string& text) {
            const char* end = text.data() + text.size();
            const auto [read_to, error] = std::from_chars(text.data(), end, result);
            return error == std::errc() && read_to == end;
          }};
}

void read_named_options(std::string_view solver, const std::map<std::string, std::string>& given,
                        const std::vector<NamedOption>& options) {
  for (const auto& [name, text] : given) {
    const auto option = std::ranges::find(options, name, &NamedOption::name);
    if (option == options.end()) {
      std::vector<std::string_view> known;
      known.reserve(options.size());
      for (const NamedOption& each : options) known.push_back(each.name);
      throw Error(fmt::format("the solver {} has no option {}; it has {}", solver, name, listed(known, "and")));
    }
    if (!option->read(text)) {
      throw Error(fmt::format("the solver {}: {} must be {}, not {}", solver, name, listed(option->takes, "or"), text));
    }
  }
}

}  // namespace dmocbench
