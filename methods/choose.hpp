#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "methods/error.hpp"

namespace dmocbench {

/// The names of all entries of a table, in its order; `name_of` gives the name of one, or is the member that holds it.
template <class Table, class NameOf>
[[nodiscard]] std::vector<std::string> names_of(const Table& table, const NameOf& name_of) {
  std::vector<std::string> names;
  names.reserve(std::size(table));
  for (const auto& entry : table) names.emplace_back(std::invoke(name_of, entry));
  return names;
}

/// The candidate that a mistyped name most likely stands for: at most a third of its letters are added, left out,
/// replaced or swapped with the next one, and upper and lower case are the same. Empty if there is none.
[[nodiscard]] inline std::string likely_meant(std::string_view name, const std::vector<std::string>& candidates) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  std::string best;
  std::size_t least = name.size() / 3 + 1;
  for (const std::string& candidate : candidates) {
    // Distances between the first i letters of the name, of i - 1, of i - 2, and every beginning of the candidate.
    std::vector<std::size_t> two_before;
    std::vector<std::size_t> before;
    std::vector<std::size_t> distance(candidate.size() + 1);
    std::iota(distance.begin(), distance.end(), std::size_t{0});
    for (std::size_t i = 1; i <= name.size(); ++i) {
      two_before = std::exchange(before, distance);
      distance[0] = i;
      for (std::size_t j = 1; j <= candidate.size(); ++j) {
        const bool is_equal = lower(name[i - 1]) == lower(candidate[j - 1]);
        distance[j] = std::min({before[j] + 1, distance[j - 1] + 1, before[j - 1] + (is_equal ? 0 : 1)});
        const bool is_swapped = i > 1 && j > 1 && name[i - 1] == candidate[j - 2] && name[i - 2] == candidate[j - 1];
        if (is_swapped) distance[j] = std::min(distance[j], two_before[j - 2] + 1);
      }
    }
    if (distance.back() < least) {
      least = distance.back();
      best = candidate;
    }
  }
  return best;
}

/// The position in `table` of the entry with that name. Throws `Error` if there is none: "`refusal` "name"; choose one
/// of a, b", with "(did you mean a?)" where one name is close; `refusal` is such as "there is no method".
template <class Table, class NameOf>
[[nodiscard]] std::size_t position_of(const Table& table, const NameOf& name_of, std::string_view name,
                                      const std::string& refusal) {
  const std::vector<std::string> names = names_of(table, name_of);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string known;
  for (const std::string& candidate : names) known += (known.empty() ? "; choose one of " : ", ") + candidate;
  const std::string meant = likely_meant(name, names);
  throw Error(refusal + " \"" + std::string(name) + "\"" + (meant.empty() ? "" : " (did you mean " + meant + "?)") +
              (known.empty() ? "; there are none" : known));
}

/// The entry of `table` with that name; throws as `position_of`.
template <class Table, class NameOf>
[[nodiscard]] const auto& one_of(const Table& table, const NameOf& name_of, std::string_view name,
                                 const std::string& refusal) {
  return table[position_of(table, name_of, name, refusal)];
}

/// One entry of a table of names and their values.
template <class Value>
struct Named {
  std::string_view name;  ///< as a user gives it
  Value value;            ///< its meaning
};

/// The value of the name in a table of `Named`; throws as `position_of`.
template <class Table>
[[nodiscard]] auto value_named(const Table& table, std::string_view name, const std::string& refusal) {
  return one_of(
             table, [](const auto& entry) { return entry.name; }, name, refusal)
      .value;
}

}  // namespace dmocbench
