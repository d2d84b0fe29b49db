#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "methods/runtime/lane_loops.hpp"

namespace dmocbench::batch {

/// Number of lanes as Eigen counts.
inline constexpr auto width = static_cast<Eigen::Index>(instance_lanes);

/// One number of every lane.
using OfLanes = Eigen::Array<double, width, 1>;

/// A vector of every lane, interleaved (lane_loops.hpp), and aligned as vector registers require.
class LaneVector {
 public:
  /// A vector of `size` zeros.
  explicit LaneVector(Eigen::Index size = 0) : lines_(static_cast<std::size_t>(size)) {}

  [[nodiscard]] Eigen::Index size() const noexcept { return static_cast<Eigen::Index>(lines_.size()); }
  [[nodiscard]] double* data() noexcept { return lines_.data()->numbers.data(); }
  [[nodiscard]] const double* data() const noexcept { return lines_.data()->numbers.data(); }

  /// Entry i of all lanes.
  [[nodiscard]] auto operator[](Eigen::Index i) { return Eigen::Map<OfLanes>(data() + i * width); }
  [[nodiscard]] auto operator[](Eigen::Index i) const { return Eigen::Map<const OfLanes>(data() + i * width); }
  /// The vector of one lane.
  [[nodiscard]] auto of(std::size_t lane) {
    return Eigen::Map<Eigen::VectorXd, 0, Stride>(data() + lane, size(), Stride(width));
  }
  [[nodiscard]] auto of(std::size_t lane) const {
    return Eigen::Map<const Eigen::VectorXd, 0, Stride>(data() + lane, size(), Stride(width));
  }

  void swap(LaneVector& other) noexcept { lines_.swap(other.lines_); }

 private:
  using Stride = Eigen::InnerStride<>;
  struct alignas(width * sizeof(double)) Line {
    std::array<double, instance_lanes> numbers{};
  };
  std::vector<Line> lines_;
};

}  // namespace dmocbench::batch
