#include "methods/solvers/named_options.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/error.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

/// "a, b or c".
std::string listed(std::vector<std::string> words, std::string_view conjunction) {
  const std::string last = words.back();
  words.pop_back();
  return words.empty() ? last : fmt::format("{} {} {}", fmt::join(words, ", "), conjunction, last);
}

}  // namespace

NamedOption named_option(std::string_view name, std::uint32_t& result) {
  return {.name = name, .takes = {"a whole number"}, .read = [&result](const std::string& text) {
            const auto number = parsed<std::uint32_t>(text);
            result = number.value_or(result);
            return number.has_value();
          }};
}

NamedOptions read_known_options(std::string_view solver, const NamedOptions& given,
                                const std::vector<NamedOption>& options) {
  NamedOptions others;
  for (const auto& [name, text] : given) {
    const auto option = std::ranges::find(options, name, &NamedOption::name);
    if (option == options.end()) {
      others.emplace(name, text);
    } else if (!option->read(text)) {
      throw Error("the solver {}: {} must be {}, not {}", solver, name, listed(option->takes, "or"), text);
    }
  }
  return others;
}

void read_named_options(std::string_view solver, const NamedOptions& given, const std::vector<NamedOption>& options) {
  const NamedOptions others = read_known_options(solver, given, options);
  if (others.empty()) return;
  throw Error("the solver {} has no option {}; it has {}", solver, others.begin()->first,
              listed(names_of(options, &NamedOption::name), "and"));
}

}  // namespace dmocbench
