#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace dmocbench::sqp {

/// Which of the n + m columns of (A, -I) are basic (m, in the order of the positions of the basis), superbasic (free to
/// move, one per degree of freedom in use) or nonbasic (held at their present value).
///
/// Every change below moves at most one column into a set and one out of it.
class WorkingSet {
 public:
  enum class Membership : std::uint8_t { basic, superbasic, nonbasic };

  WorkingSet() = default;

  /// All slacks basic, all variables nonbasic.
  [[nodiscard]] static WorkingSet slack_start(Eigen::Index variables, Eigen::Index rows) {
    std::vector<Eigen::Index> basics;
    for (Eigen::Index i = 0; i < rows; ++i) basics.push_back(variables + i);
    return {variables + rows, std::move(basics), {}};
  }

  WorkingSet(Eigen::Index columns, std::vector<Eigen::Index> basics, std::vector<Eigen::Index> superbasics)
      : basics_(std::move(basics)),
        superbasics_(std::move(superbasics)),
        membership_(static_cast<std::size_t>(columns), Membership::nonbasic) {
    for (const Eigen::Index j : basics_) at(j) = Membership::basic;
    for (const Eigen::Index j : superbasics_) at(j) = Membership::superbasic;
  }

  [[nodiscard]] const std::vector<Eigen::Index>& basics() const noexcept { return basics_; }
  [[nodiscard]] const std::vector<Eigen::Index>& superbasics() const noexcept { return superbasics_; }
  [[nodiscard]] Membership of(Eigen::Index j) const { return membership_[static_cast<std::size_t>(j)]; }
  [[nodiscard]] Eigen::Index columns() const noexcept { return static_cast<Eigen::Index>(membership_.size()); }

  /// A nonbasic column may move from now on.
  void make_superbasic(Eigen::Index j) {
    at(j) = Membership::superbasic;
    superbasics_.push_back(j);
  }

  /// The superbasic column at `place` in the list stays where it is from now on.
  void drop_superbasic(Eigen::Index place) {
    const auto position = superbasics_.begin() + place;
    at(*position) = Membership::nonbasic;
    superbasics_.erase(position);
  }

  /// Column `entering`, nonbasic or superbasic, takes the place of the basic column at `position`, which becomes
  /// nonbasic.
  void replace_basic(Eigen::Index position, Eigen::Index entering) {
    if (of(entering) == Membership::superbasic) std::erase(superbasics_, entering);
    Eigen::Index& place = basics_[static_cast<std::size_t>(position)];
    at(place) = Membership::nonbasic;
    at(entering) = Membership::basic;
    place = entering;
  }

 private:
  Membership& at(Eigen::Index j) { return membership_[static_cast<std::size_t>(j)]; }

  std::vector<Eigen::Index> basics_;
  std::vector<Eigen::Index> superbasics_;
  std::vector<Membership> membership_;
};

}  // namespace dmocbench::sqp
