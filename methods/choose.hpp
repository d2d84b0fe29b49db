#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
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

/// The position in `table` of the entry with that name. Throws `Error` if there is none: "`refusal` "name"; choose one
/// of a, b", where `refusal` is such as "there is no method".
template <class Table, class NameOf>
[[nodiscard]] std::size_t position_of(const Table& table, const NameOf& name_of, std::string_view name,
                                      const std::string& refusal) {
  std::string known;
  std::size_t position = 0;
  for (const auto& entry : table) {
    const std::string candidate(std::invoke(name_of, entry));
    if (candidate == name) return position;
    known += (position++ == 0 ? "; choose one of " : ", ") + candidate;
  }
  throw Error(refusal + " \"" + std::string(name) + "\"" + (known.empty() ? "; there are none" : known));
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
