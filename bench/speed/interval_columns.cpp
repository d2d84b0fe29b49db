#include "bench/speed/interval_columns.hpp"

#include <memory>

#include "methods/expression/tape.hpp"

namespace dmocbench::speed {

IntervalColumns::IntervalColumns(std::size_t count, std::size_t intervals) {
  constexpr std::size_t line = 64;
  const std::size_t stride = intervals + Tape::block_width;
  values_.resize(count * stride + line / sizeof(double));
  void* head = values_.data();
  std::size_t space = values_.size() * sizeof(double);
  auto* first = static_cast<double*>(std::align(line, sizeof(double), head, space));
  for (std::size_t j = 0; j < count; ++j) columns_.push_back(first + j * stride);
}

std::vector<double> IntervalColumns::row(std::size_t interval) const {
  std::vector<double> numbers;
  numbers.reserve(columns_.size());
  for (const double* column : columns_) numbers.push_back(column[interval]);
  return numbers;
}

}  // namespace dmocbench::speed
