#include "bench/tables/paired_solves.hpp"

#include <algorithm>
#include <iterator>
#include <map>

namespace dmocbench {

std::vector<SolvePair> paired_solves(const Selection& first, const Selection& second, const ColumnNames& key) {
  std::map<std::string, std::reference_wrapper<const Row>> by_key;
  for (const Row& row : second) by_key.emplace(row.csv(key), row);
  std::vector<SolvePair> pairs;
  for (const Row& row : first) {
    const auto found = by_key.find(row.csv(key));
    if (found != by_key.end()) pairs.push_back({row, found->second});
  }
  return pairs;
}

bool solves_program(const Row& row) {
  const std::string& status = row.text("status");
  return status == "solved" || status == "too coarse";
}

PairedCount count_of(const std::vector<SolvePair>& pairs) {
  PairedCount count;
  for (const SolvePair& pair : pairs) {
    const bool first = solves_program(pair.first);
    const bool second = solves_program(pair.second);
    ++(first ? (second ? count.both : count.first_only) : (second ? count.second_only : count.neither));
  }
  return count;
}

std::vector<SolvePair> lost_by_first(const std::vector<SolvePair>& pairs) {
  std::vector<SolvePair> lost;
  std::ranges::copy_if(pairs, std::back_inserter(lost), [](const SolvePair& pair) {
    return !solves_program(pair.first) && solves_program(pair.second);
  });
  return lost;
}

std::vector<double> iteration_ratios(const std::vector<SolvePair>& pairs) {
  std::vector<double> ratios;
  for (const SolvePair& pair : pairs) {
    if (!solves_program(pair.first) || !solves_program(pair.second)) continue;
    const double first = pair.first.get().number("major_iterations", 0.0);
    const double second = pair.second.get().number("major_iterations", 0.0);
    if (first > 0.0 && second > 0.0) ratios.push_back(first / second);
  }
  std::ranges::sort(ratios);
  return ratios;
}

}  // namespace dmocbench
