#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace dmocbench::speed {

/// The repetitions of every benchmark that ran.
class Measurements {
 public:
  void add(const std::string& name, double ns_per_interval, double operations);

  [[nodiscard]] bool empty() const noexcept { return by_name_.empty(); }
  // Nothing if no benchmark of that name ran.
  [[nodiscard]] std::optional<double> median(const std::string& name) const;
  [[nodiscard]] std::optional<double> smallest(const std::string& name) const;
  [[nodiscard]] std::optional<double> operations(const std::string& name) const;

 private:
  struct Measured {
    std::vector<double> ns_per_interval;
    double operations = 0.0;
  };
  [[nodiscard]] const Measured* find(const std::string& name) const;
  std::map<std::string, Measured> by_name_;
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
