#include "methods/solvers/named_options.hpp"

#include <algorithm>
#include <charconv>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// "a, b or c".
std::string listed(std::span<const std::string_view> names, std::string_view last) {
  if (names.size() < 2) return std::string(names.front());
  return fmt::format("{} {} {}", fmt::join(names.first(names.size() - 1), ", "), last, names.back());
}

}  // namespace

const std::string* NamedOptions::find(std::string_view option) {
  known_.push_back(option);
  const auto found = given_.find(std::string(option));
  return found == given_.end() ? nullptr : &found->second;
}

void NamedOptions::refuse(std::string_view option, std::string_view text,
                          const std::vector<std::string_view>& names) const {
  throw Error(fmt::format("the solver {}: {} must be {}, not {}", solver_, option, listed(names, "or"), text));
}

void NamedOptions::read(std::string_view option, std::uint32_t& result) {
  const std::string* text = find(option);
  if (text == nullptr) return;
  const char* end = text->data() + text->size();
  const auto [read_to, error] = std::from_chars(text->data(), end, result);
  if (error != std::errc() || read_to != end) refuse(option, *text, {"a whole number"});
}

void NamedOptions::refuse_others() const {
  for (const auto& [option, value] : given_) {
    if (std::ranges::find(known_, option) != known_.end()) continue;
    throw Error(fmt::format("the solver {} has no option {}; it has {}", solver_, option, listed(known_, "and")));
  }
}

}  // namespace dmocbench
