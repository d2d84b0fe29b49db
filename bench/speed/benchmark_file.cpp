#include "bench/speed/benchmark_file.hpp"

#include <algorithm>
#include <limits>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "methods/error.hpp"
#include "methods/numerics/median.hpp"

namespace dmocbench {

namespace {

using nlohmann::json;

/// The fields of a repetition in Google Benchmark's file besides times and counters.
const std::set<std::string, std::less<>> descriptions{"family_index", "per_family_instance_index", "repetitions",
                                                      "repetition_index", "threads"};

/// Google Benchmark writes NaN and Infinity, which JSON does not have; here they become null.
json parsed(const std::string& text, const std::filesystem::path& file) {
  static const std::regex not_finite(R"(": -?(NaN|Infinity))");
  try {
    return json::parse(std::regex_replace(text, not_finite, "\": null"));
  } catch (const json::exception&) {
    throw Error(fmt::format("{} is not JSON; write one with --benchmark_out={}", file.string(), file.string()));
  }
}

double nanoseconds_of(const std::string& unit, const std::filesystem::path& file) {
  static const std::map<std::string, double> units{{"ns", 1.0}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}};
  const auto found = units.find(unit);
  if (found == units.end()) throw Error(fmt::format("{} has times in {}, an unknown unit", file.string(), unit));
  return found->second;
}

void add_repetition(Benchmark& benchmark, const json& run, const std::filesystem::path& file) {
  for (const auto& [key, value] : run.items()) {
    if (descriptions.contains(key) || !(value.is_number() || value.is_null())) continue;
    const bool is_time = key == "cpu_time" || key == "real_time";
    const double unit = is_time ? nanoseconds_of(run.value("time_unit", "ns"), file) : 1.0;
    benchmark.numbers[key].push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                                     : unit * value.get<double>());
  }
  std::istringstream label(run.value("label", ""));
  for (std::string word; label >> word;) {
    const std::size_t sign = word.find('=');
    if (sign != std::string::npos) benchmark.labels[word.substr(0, sign)] = word.substr(sign + 1);
  }
}

}  // namespace

std::string Benchmark::label(std::string_view key) const {
  const auto found = labels.find(key);
  return found == labels.end() ? "" : found->second;
}

std::optional<double> Benchmark::median_of(std::string_view number) const {
  const auto found = numbers.find(number);
  return found == numbers.end() ? std::nullopt : std::optional(median(found->second));
}

std::optional<double> Benchmark::smallest_of(std::string_view number) const {
  const auto found = numbers.find(number);
  return found == numbers.end() ? std::nullopt : std::optional(*std::ranges::min_element(found->second));
}

Benchmarks parse_benchmarks(const std::string& text, const std::filesystem::path& file) {
  const json content = parsed(text, file);
  Benchmarks benchmarks;
  try {
    for (const json& run : content.at("benchmarks")) {
      if (run.value("run_type", "iteration") != "iteration" || run.value("error_occurred", false)) continue;
      const std::string name = run.contains("run_name") ? run.at("run_name") : run.at("name");
      add_repetition(benchmarks[name], run, file);
    }
  } catch (const json::exception&) {  // something is missing or of another type
    throw Error(fmt::format("{} is JSON, but not of Google Benchmark; write one with --benchmark_out", file.string()));
  }
  return benchmarks;
}

}  // namespace dmocbench
