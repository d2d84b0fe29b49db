#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "methods/choose.hpp"

namespace dmocbench {

/// An option of one of our own solvers that a command line may give as text.
struct NamedOption {
  std::string_view name;
  std::vector<std::string> takes;                ///< the words it takes, for people
  std::function<bool(const std::string&)> read;  ///< sets the typed option; false if the text is none of these
};

/// An option that is one of several choices.
template <class Choice>
NamedOption named_option(std::string_view name, Choice& result,
                         const std::vector<std::pair<std::string_view, Choice>>& choices) {
  using WordAndChoice = std::pair<std::string_view, Choice>;
  return {.name = name,
          .takes = names_of(choices, &WordAndChoice::first),
          .read = [&result, choices](const std::string& text) {
            const auto found = std::ranges::find(choices, text, &WordAndChoice::first);
            if (found != choices.end()) result = found->second;
            return found != choices.end();
          }};
}

/// An option that is a whole number.
[[nodiscard]] NamedOption named_option(std::string_view name, std::uint32_t& result);

/// Sets typed options from text, name=value. Throws `Error` that names the solver, the option and what it takes.
void read_named_options(std::string_view solver, const std::map<std::string, std::string>& given,
                        const std::vector<NamedOption>& options);

}  // namespace dmocbench
