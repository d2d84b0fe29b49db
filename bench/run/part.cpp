#include "bench/run/part.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "bench/run/written_tables.hpp"
#include "methods/error.hpp"
#include "methods/runtime/parsed.hpp"

namespace dmocbench {

namespace {

/// A number of digits alone: no sign, no blank.
std::optional<std::size_t> parse_digits(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  return parsed<std::size_t>(text);
}

/// The first case of a case's group; shortens the way there.
std::size_t first_of_group(std::vector<std::size_t>& groups, std::size_t number) {
  while (groups[number] != number) number = groups[number] = groups[groups[number]];
  return number;
}

}  // namespace

std::string Part::in_words() const { return fmt::format("{}/{}", number, of); }

std::string Part::file_name() const {
  return fmt::format("{:0{}}-of-{}.part", number, fmt::formatted_size("{}", of), of);
}

Part parse_part(std::string_view option, std::string_view text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto number = parse_digits(text.substr(0, slash));
  const auto of = parse_digits(text.substr(std::min(slash + 1, text.size())));
  if (number && of && *number >= 1 && *number <= *of && *of <= most_parts_of_a_run) return {*number, *of};
  constexpr std::size_t most_shown = 40;
  throw Error(fmt::format("{} takes i/n, part i of n with 1 <= i <= n <= {}, as in 3/16; not \"{}\"{}", option,
                          most_parts_of_a_run, text.substr(0, most_shown), text.size() > most_shown ? " ..." : ""));
}

std::vector<std::size_t> groups_of(const std::vector<Case>& cases, const std::vector<SharedBy>& respects) {
  std::vector<std::size_t> groups(cases.size());
  std::iota(groups.begin(), groups.end(), 0U);
  for (const SharedBy& shared_by : respects) {
    std::unordered_map<std::string, std::size_t> first_with;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const std::string words = shared_by(cases[i]);
      if (words.empty()) continue;
      const std::size_t here = first_of_group(groups, i);
      const std::size_t there = first_of_group(groups, first_with.try_emplace(words, i).first->second);
      groups[std::max(here, there)] = std::min(here, there);
    }
  }
  for (std::size_t i = 0; i < cases.size(); ++i) groups[i] = first_of_group(groups, i);
  return groups;
}

std::vector<std::size_t> dealt_out(const std::vector<Case>& cases, const std::vector<std::size_t>& groups,
                                   std::size_t parts) {
  std::vector<std::pair<std::uint32_t, std::size_t>> order;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (groups[i] == i) order.emplace_back(crc_32(fmt::format("{} {}", cases[i].label(), i)), i);
  }
  std::ranges::sort(order);
  std::vector<std::size_t> part_of(cases.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank) part_of[order[rank].second] = rank % parts + 1;
  for (std::size_t i = 0; i < cases.size(); ++i) part_of[i] = part_of[groups[i]];
  return part_of;
}

}  // namespace dmocbench
