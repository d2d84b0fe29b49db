#include "bench/speed/measurements.hpp"

#include <algorithm>

#include "bench/speed/benchmarks.hpp"

namespace dmocbench::speed {

void Measurements::add(const std::string& name, double ns, double operations) {
  Measured& measured = by_name_[name];
  measured.ns_per_interval.push_back(ns);
  measured.operations = operations;
}

const Measurements::Measured* Measurements::find(const std::string& name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : &found->second;
}

std::optional<double> Measurements::median(const std::string& name) const {
  const Measured* measured = find(name);
  if (measured == nullptr) return std::nullopt;
  std::vector<double> sorted = measured->ns_per_interval;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2.0;
}

std::optional<double> Measurements::smallest(const std::string& name) const {
  const Measured* measured = find(name);
  if (measured == nullptr) return std::nullopt;
  return *std::min_element(measured->ns_per_interval.begin(), measured->ns_per_interval.end());
}

std::optional<double> Measurements::operations(const std::string& name) const {
  const Measured* measured = find(name);
  return measured == nullptr ? std::nullopt : std::optional(measured->operations);
}

void CollectingReporter::ReportRuns(const std::vector<Run>& runs) {
  std::vector<Run> printed;
  for (const Run& run : runs) {
    const bool is_repetition = run.run_type == Run::RT_Iteration;
    if (is_repetition && !run.error_occurred) {
      measurements_.add(run.run_name.function_name, run.counters.at(ns_per_interval),
                        run.counters.at(operations_per_interval));
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
