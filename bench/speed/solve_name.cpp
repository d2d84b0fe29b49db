#include "bench/speed/solve_name.hpp"

#include <charconv>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "methods/error.hpp"

namespace dmocbench::speed {

namespace {

constexpr std::string_view library_mark = "library";
constexpr std::string_view threads_mark = "threads_";

/// 0 if it is none.
int positive_number(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number > 0 ? number : 0;
}

}  // namespace

std::string SolveName::text() const {
  return fmt::format("{}{}/{}/{}/{}{}", is_of_library ? fmt::format("{}/", library_mark) : "", problem, method,
                     intervals, solver, threads == 1 ? "" : fmt::format("/{}{}", threads_mark, threads));
}

SolveName SolveName::parse(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, '/');) parts.push_back(part);
  SolveName name;
  if (!parts.empty() && parts.front() == library_mark) {
    name.is_of_library = true;
    parts.erase(parts.begin());
  }
  if (parts.size() == 5 && parts[4].starts_with(threads_mark)) {
    name.threads = positive_number(std::string_view(parts[4]).substr(threads_mark.size()));
    parts.pop_back();
  }
  if (parts.size() == 4) {
    name.problem = parts[0];
    name.method = parts[1];
    name.intervals = positive_number(parts[2]);
    name.solver = parts[3];
  }
  if (name.intervals == 0 || name.threads == 0) throw Error("\"" + text + "\" is not the name of a solve");
  return name;
}

}  // namespace dmocbench::speed
