#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace dmocbench::speed {

/// The counters of every repetition of every benchmark that ran.
class Measurements {
 public:
  void add(const std::string& name, const std::string& counter, double value);

  [[nodiscard]] bool empty() const noexcept { return by_name_.empty(); }
  /// Of the benchmarks that ran, in alphabetical order.
  [[nodiscard]] std::vector<std::string> names() const;
  // Nothing if no benchmark of that name ran or it has no such counter.
  [[nodiscard]] std::optional<double> median(const std::string& name, const std::string& counter) const;
  [[nodiscard]] std::optional<double> smallest(const std::string& name, const std::string& counter) const;
  /// 0 if it did not run.
  [[nodiscard]] std::size_t repetitions(const std::string& name) const;

 private:
  using Counters = std::map<std::string, std::vector<double>>;
  [[nodiscard]] const std::vector<double>* find(const std::string& name, const std::string& counter) const;
  std::map<std::string, Counters> by_name_;
};

/// Prints one line per benchmark, its median, and keeps all repetitions.
class CollectingReporter final : public benchmark::ConsoleReporter {
 public:
  CollectingReporter() : ConsoleReporter(OO_None) {}
  void ReportRuns(const std::vector<Run>& runs) override;  // NOLINT(readability-identifier-naming): the base's name
  [[nodiscard]] const Measurements& measurements() const noexcept { return measurements_; }

 private:
  Measurements measurements_;
};

}  // namespace dmocbench::speed
