#include "methods/transcription/column_assembly.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "methods/error.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/runtime/vector_loops.hpp"

namespace dmocbench {

ColumnAssembly::ColumnAssembly(std::vector<ColumnPlace> places, std::size_t size, std::size_t intervals,
                               AssemblyMode mode)
    : places_(std::move(places)), size_(size), intervals_(intervals), columns_(places_.size()) {
  std::vector<std::size_t> order(places_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return places_[a].first < places_[b].first; });
  std::size_t covered = 0;  // entries below are written, set to zero or added to
  const auto zero_until = [&](std::size_t end) {
    for (; covered < end && mode == AssemblyMode::whole; ++covered) zeros_.push_back(covered);
  };
  for (const std::size_t column : order) {
    const ColumnPlace& place = places_[column];
    const std::size_t end = place.at(intervals_ - 1) + 1;
    if (end > size_) throw Error("a column leaves the array that it is assembled to");
    if (mode == AssemblyMode::part || place.shared || place.first < covered) {
      add_later(column);
      zero_until(end);
    } else {
      zero_until(place.first);
      covered = end;
    }
  }
  zero_until(size_);
  scratch_.resize(additions_.size() * intervals_);
}

void ColumnAssembly::add_later(std::size_t column) {
  additions_.push_back({column, additions_.size() * intervals_, places_[column]});
}

std::span<double* const> ColumnAssembly::open(VectorOut& result) {
  if (static_cast<std::size_t>(result.size()) != size_)
    throw Error("columns are assembled to an array of wrong length");
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    columns_[column] = result.data() + places_[column].first;
  }
  for (const Addition& addition : additions_) columns_[addition.column] = scratch_.data() + addition.scratch;
  return columns_;
}

void ColumnAssembly::close(VectorOut& result) const {
  for (const std::size_t entry : zeros_) result.data()[entry] = 0.0;
  // Columns that begin at different entries may share some: a part has a stretch of intervals of one column alone.
  constexpr std::size_t additions_per_part = 65536;
  const std::size_t parts = part_count(intervals_, additions_per_part);
  for (const Addition& addition : additions_) {
    double* target = result.data() + addition.place.first;
    const double* source = scratch_.data() + addition.scratch;
    if (addition.place.shared) {
      *target += Eigen::Map<const Eigen::VectorXd>(source, static_cast<Eigen::Index>(intervals_)).sum();
      continue;
    }
    for_each_part(parts, [&](std::size_t part) {
      const std::size_t begin = begin_of_part(part, parts, intervals_);
      const auto count = static_cast<std::ptrdiff_t>(begin_of_part(part + 1, parts, intervals_) - begin);
      vector_loops().set_to_sum(target + begin, target + begin, 1.0, source + begin, count);
    });
  }
}

}  // namespace dmocbench
