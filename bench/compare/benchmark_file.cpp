#include "bench/compare/benchmark_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/experiment/result_file.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

using nlohmann::json;

/// What Google Benchmark writes of a repetition besides times and counters.
const std::set<std::string, std::less<>> descriptions{"family_index", "per_family_instance_index", "repetitions",
                                                      "repetition_index", "threads"};

constexpr std::array<std::string_view, 4> unknown_numbers{"NaN", "-NaN", "Infinity", "-Infinity"};

/// The text with null in place of NaN and Infinity, which Google Benchmark writes, for instance of a counter that is 0
/// in all repetitions, and JSON does not know.
std::string with_known_numbers(const std::string& text) {
  std::string known;
  known.reserve(text.size());
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = std::string_view(text).substr(i);
    if (in_string && rest.starts_with('\\')) {
      known += rest.substr(0, 2);
      ++i;
      continue;
    }
    if (text[i] == '"') in_string = !in_string;
    const auto* const unknown =
        std::find_if(unknown_numbers.begin(), unknown_numbers.end(),
                     [&](std::string_view word) { return !in_string && rest.starts_with(word); });
    if (unknown == unknown_numbers.end()) {
      known += text[i];
    } else {
      known += "null";
      i += unknown->size() - 1;
    }
  }
  return known;
}

json parsed(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  try {
    return json::parse(with_known_numbers(text));
  } catch (const json::exception&) {
    throw Error(fmt::format("{} is not JSON; write one with --benchmark_out={}", file.string(), file.string()));
  }
}

double nanoseconds_of(const json& run, const std::filesystem::path& file) {
  const std::string unit = run.value("time_unit", "ns");
  static const std::map<std::string, double> units{{"ns", 1.0}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}};
  const auto found = units.find(unit);
  if (found == units.end()) throw Error(fmt::format("{} has times in {}, an unknown unit", file.string(), unit));
  return found->second;
}

bool is_repetition(const json& run) {
  return run.value("run_type", "iteration") == "iteration" && !run.value("error_occurred", false);
}

std::set<std::string> counters_of(const json& run) {
  std::set<std::string> names;
  for (const auto& [key, value] : run.items()) {
    if (value.is_number() && !descriptions.contains(key)) names.insert(key);
  }
  return names;
}

BenchmarkSamples samples_of(const json& runs, std::string_view counter, const std::filesystem::path& file) {
  BenchmarkSamples samples;
  std::set<std::string> counters;
  for (const json& run : runs) {
    if (!is_repetition(run)) continue;
    counters.merge(counters_of(run));
    const auto found = run.find(counter);
    if (found == run.end()) continue;
    const std::string name = run.contains("run_name") ? run.at("run_name") : run.at("name");
    const bool is_time = counter == "cpu_time" || counter == "real_time";
    const double told = found->is_null() ? std::numeric_limits<double>::quiet_NaN() : found->get<double>();
    const double value = told * (is_time ? nanoseconds_of(run, file) : 1.0);
    if (!std::isfinite(value) || value <= 0.0) {
      throw Error(fmt::format("{} of {} in {} is {}, of which there are no ratios; choose another --counter", counter,
                              name, file.string(), value));
    }
    samples[name].push_back(value);
  }
  if (counters.empty()) {
    throw Error(
        fmt::format("{} holds no repetition of any benchmark; aggregates alone do not tell noise", file.string()));
  }
  if (samples.empty()) {
    throw Error(fmt::format("no benchmark in {} has the counter {}; there are {}", file.string(), counter,
                            fmt::join(counters, ", ")));
  }
  return samples;
}

}  // namespace

BenchmarkSamples read_samples(const std::filesystem::path& file, std::string_view counter) {
  const json content = parsed(file);
  try {
    return samples_of(content.at("benchmarks"), counter, file);
  } catch (const json::exception&) {  // something is missing or of another type
    throw Error(fmt::format("{} is JSON, but not of Google Benchmark; write one with --benchmark_out", file.string()));
  }
}

BenchmarkSamples read_samples(const std::vector<std::filesystem::path>& files, std::string_view counter) {
  if (files.empty()) throw Error("no file of a run is named; write one with --benchmark_out");
  if (files.size() == 1) return read_samples(files.front(), counter);
  BenchmarkSamples samples;
  for (const std::filesystem::path& file : files) {
    for (const auto& [name, values] : read_samples(file, counter)) samples[name].push_back(median_of(values));
  }
  return samples;
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2.0;
}

}  // namespace dmocbench
