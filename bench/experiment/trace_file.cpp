#include "bench/experiment/trace_file.hpp"

#include <fmt/format.h>

namespace dmocbench {

Table trace_table(const std::vector<MinorIteration>& trace, Eigen::Index variables) {
  Table table({"major", "phase", "entering", "leaving", "into_basis", "step", "infeasibility", "objective",
               "superbasics", "basic_slacks"});
  const auto named = [&](std::optional<Eigen::Index> column) -> Cell {
    if (!column) return {};
    return *column < variables ? fmt::format("x{}", *column) : fmt::format("s{}", *column - variables);
  };
  for (const MinorIteration& minor : trace) {
    Row row;
    row.set("major", static_cast<long long>(minor.major));
    row.set("phase", static_cast<long long>(minor.phase));
    row.set("entering", named(minor.entering));
    row.set("leaving", named(minor.leaving));
    row.set("into_basis", named(minor.into_basis));
    row.set("step", minor.step);
    row.set("infeasibility", minor.infeasibility);
    row.set("objective", minor.objective);
    row.set("superbasics", static_cast<long long>(minor.superbasics));
    row.set("basic_slacks", static_cast<long long>(minor.basic_slacks));
    table.append(std::move(row));
  }
  return table;
}

}  // namespace dmocbench
