#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dmocbench {

/// A word that stands for a choice on the command line.
template <class Choice>
using NamedChoice = std::pair<std::string_view, Choice>;

/// Reads options that were given as text, name=value, into the typed options of one of our own solvers. Every refusal
/// is an `Error` that names the solver, the option and what it takes.
class NamedOptions {
 public:
  NamedOptions(std::string_view solver, const std::map<std::string, std::string>& given)
      : solver_(solver), given_(given) {}

  /// Sets `result` to the choice that the option names, if it was given.
  template <class Choice, std::size_t count>
  void read(std::string_view option, Choice& result, const std::array<NamedChoice<Choice>, count>& choices) {
    const std::string* text = find(option);
    if (text == nullptr) return;
    std::vector<std::string_view> names;
    for (const auto& [name, choice] : choices) {
      names.push_back(name);
      if (*text != name) continue;
      result = choice;
      return;
    }
    refuse(option, *text, names);
  }
  /// Sets `result` to the whole number that the option gives, if it was given.
  void read(std::string_view option, std::uint32_t& result);

  /// Refuses an option that was given but never read.
  void refuse_others() const;

 private:
  [[nodiscard]] const std::string* find(std::string_view option);
  [[noreturn]] void refuse(std::string_view option, std::string_view text,
                           const std::vector<std::string_view>& names) const;

  std::string_view solver_;
  const std::map<std::string, std::string>& given_;
  std::vector<std::string_view> known_;
};

}  // namespace dmocbench
