#include "bench/speed/measurements.hpp"

#include <algorithm>

#include "bench/speed/benchmarks.hpp"

namespace dmocbench::speed {

void Measurements::add(const std::string& name, const std::string& counter, double value) {
  by_name_[name][counter].push_back(value);
}

std::vector<std::string> Measurements::names() const {
  std::vector<std::string> all;
  all.reserve(by_name_.size());
  for (const auto& [name, counters] : by_name_) all.push_back(name);
  return all;
}

const std::vector<double>* Measurements::find(const std::string& name, const std::string& counter) const {
  const auto counters = by_name_.find(name);
  if (counters == by_name_.end()) return nullptr;
  const auto found = counters->second.find(counter);
  return found == counters->second.end() ? nullptr : &found->second;
}

std::optional<double> Measurements::median(const std::string& name, const std::string& counter) const {
  const std::vector<double>* values = find(name, counter);
  if (values == nullptr) return std::nullopt;
  std::vector<double> sorted = *values;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2.0;
}

std::optional<double> Measurements::smallest(const std::string& name, const std::string& counter) const {
  const std::vector<double>* values = find(name, counter);
  if (values == nullptr) return std::nullopt;
  return *std::min_element(values->begin(), values->end());
}

std::size_t Measurements::repetitions(const std::string& name) const {
  const auto counters = by_name_.find(name);
  return counters == by_name_.end() ? 0 : counters->second.begin()->second.size();
}

void CollectingReporter::ReportRuns(const std::vector<Run>& runs) {
  std::vector<Run> printed;
  for (const Run& run : runs) {
    const bool is_repetition = run.run_type == Run::RT_Iteration;
    if (is_repetition && !run.error_occurred) {
      for (const auto& [counter, value] : run.counters) {
        measurements_.add(run.run_name.function_name, counter, value.value);
      }
    }
    if (is_repetition ? run.repetitions > 1 : run.aggregate_name != "median") continue;
    printed.push_back(run);
    // Printed as a plain number; the library takes an inverse rate for seconds.
    const auto counter = printed.back().counters.find(ns_per_interval);
    if (counter != printed.back().counters.end()) counter->second.flags = benchmark::Counter::kDefaults;
  }
  ConsoleReporter::ReportRuns(printed);
}

}  // namespace dmocbench::speed
