#pragma once

#include <vector>

#include <Eigen/Core>

namespace dmocbench::interior_point {

/// Some entries of a long vector, kept as stretches of consecutive ones.
class Selection {
 public:
  /// `numbers` ascend.
  explicit Selection(const std::vector<Eigen::Index>& numbers) {
    for (const Eigen::Index number : numbers) {
      if (stretches_.empty() || number != stretches_.back().first + stretches_.back().length) {
        stretches_.push_back({number, size_, 0});
      }
      ++stretches_.back().length;
      ++size_;
    }
  }

  [[nodiscard]] Eigen::Index size() const noexcept { return size_; }

  /// `selected`: size() entries.
  void take_from(const Eigen::VectorXd& all, Eigen::Ref<Eigen::VectorXd> selected) const {
    for (const Stretch& s : stretches_) selected.segment(s.place, s.length) = all.segment(s.first, s.length);
  }
  void put_into(Eigen::VectorXd& all, const Eigen::Ref<const Eigen::VectorXd>& selected) const {
    for (const Stretch& s : stretches_) all.segment(s.first, s.length) = selected.segment(s.place, s.length);
  }

 private:
  struct Stretch {
    Eigen::Index first;  ///< in the long vector
    Eigen::Index place;  ///< among the selected ones
    Eigen::Index length;
  };

  std::vector<Stretch> stretches_;
  Eigen::Index size_ = 0;
};

}  // namespace dmocbench::interior_point
