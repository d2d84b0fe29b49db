#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "methods/choose.hpp"
#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// An option of one of our own solvers that a command line may give as text.
struct NamedOption {
  std::string_view name;
  std::vector<std::string> takes;                ///< the accepted values, for people
  std::function<bool(const std::string&)> read;  ///< sets the typed option; false if the text is none of these
};

/// An option that is one of several choices, a table of `Named`.
template <class Choice, class Table>
NamedOption named_option(std::string_view name, Choice& result, const Table& choices) {
  return {.name = name,
          .takes = names_of(choices, &Named<Choice>::name),
          .read = [&result, choices](const std::string& text) {
            const auto found = std::ranges::find(choices, text, &Named<Choice>::name);
            if (found != choices.end()) result = found->value;
            return found != choices.end();
          }};
}

/// An option that is a whole number.
[[nodiscard]] NamedOption named_option(std::string_view name, std::uint32_t& result);

/// Sets typed options from text, name=value. Throws `Error` that names the solver, the option and its permitted values.
void read_named_options(std::string_view solver, const NamedOptions& given, const std::vector<NamedOption>& options);

/// The same, except that it returns unknown names with their text.
[[nodiscard]] NamedOptions read_known_options(std::string_view solver, const NamedOptions& given,
                                              const std::vector<NamedOption>& options);

}  // namespace dmocbench
