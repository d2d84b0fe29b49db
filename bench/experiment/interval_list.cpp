#include "bench/experiment/interval_list.hpp"

#include <set>
#include <string>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/transcription/grid.hpp"

namespace dmocbench {

namespace {

long long parse_count(std::string_view option, std::string_view text) {
  const auto count = parsed<long long>(text);
  if (!count || *count < 1 || *count > Grid::most_intervals) {
    throw Error(fmt::format("{}: \"{}\" is not a whole number between 1 and {}", option, text, Grid::most_intervals));
  }
  return *count;
}

/// Cuts off what stands before the separator and moves `rest` behind it.
std::string_view take_part(std::string_view& rest, char separator) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return part;
}

}  // namespace

std::vector<long long> parse_intervals(std::string_view option, std::string_view text) {
  std::set<long long> counts;
  std::string_view rest = text;
  do {
    std::string_view entry = take_part(rest, ',');
    if (entry.find(':') == std::string_view::npos) {
      counts.insert(parse_count(option, entry));
      continue;
    }
    const std::string whole(entry);
    const long long first = parse_count(option, take_part(entry, ':'));
    const long long last = parse_count(option, entry);
    if (last < first) throw Error(fmt::format("{}: the range {} ends below its start", option, whole));
    for (long long count = first; count <= last; count *= 2) counts.insert(count);
  } while (!rest.empty());
  return {counts.begin(), counts.end()};
}

std::vector<double> parse_node_times(std::string_view text) {
  std::vector<double> times;
  for (int line = 1; !text.empty(); ++line) {
    std::string_view entry = take_part(text, '\n');
    while (!entry.empty() && (entry.back() == '\r' || entry.back() == ' ')) entry.remove_suffix(1);
    if (!entry.empty()) times.push_back(parse_number(fmt::format("--grid, line {}", line), entry));
  }
  return times;
}

std::pair<std::string_view, std::string_view> parse_assignment(std::string_view option, std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw Error(fmt::format("{} takes name=value, got \"{}\"", option, text));
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

double parse_number(std::string_view wanted_for, std::string_view text) {
  const auto value = parsed<double>(text);
  if (!value) throw Error(fmt::format("{}: \"{}\" is not a number", wanted_for, text));
  return *value;
}

}  // namespace dmocbench
