#pragma once

#include <utility>

#include "methods/runtime/long_vectors.hpp"
#include "methods/solvers/interior_point/barrier_program.hpp"
#include "methods/solvers/interior_point/constants.hpp"

namespace dmocbench::interior_point {

/// A line search that was not carried out: where it begins, the Newton step there, and what the search needs of it.
struct WatchdogStart {
  Iterate at;
  Evaluation values;
  Iterate step;
  double derivative = 0.0;  ///< of φ_μ along the step
  double longest = 0.0;     ///< the length that bounds allow, (15a)
};

/// The watchdog of Chamberlain, Powell, Lemaréchal and Pedersen ("The watchdog technique for forcing convergence in
/// algorithms for constrained optimization", Mathematical Programming Studies 16, 1982), as in Ipopt. Newton's method
/// may need a step that raises violation and cost before one that lowers both. So where search after search is
/// shortened, a few whole steps are taken even if the line search refuses them. One of them has to be acceptable as
/// seen from where they began, or the search goes on from there, as if they had not been.
///
/// What it remembers is copied when it begins, so a solve whose searches are not shortened pays nothing.
class Watchdog {
 public:
  /// Before another solve or barrier problem, before restoration, and where a whole step is acceptable: ends, and
  /// counts from zero.
  void forget() noexcept {
    shortened_ = 0;
    is_on_ = false;
  }
  /// After a search that halved its step, or did not.
  void count(bool is_shortened) noexcept { shortened_ = is_shortened ? shortened_ + 1 : 0; }

  /// Whether enough searches in a row were shortened.
  [[nodiscard]] bool is_due() const noexcept { return !is_on_ && shortened_ >= constants::watchdog_trigger; }
  /// Whether the iterate is reached, or about to be, by steps that are not judged yet.
  [[nodiscard]] bool is_on() const noexcept { return is_on_; }

  /// Remembers the iterate, its values, and the Newton step there (`WatchdogStart`).
  void begin(const Iterate& at, const Evaluation& values, const Iterate& step, double derivative, double longest) {
    copy(at, start_.at);
    copy(step, start_.step);
    static_cast<PointValues&>(start_.values) = values;
    copy_to(start_.values.constraints, values.constraints);
    start_.derivative = derivative;
    start_.longest = longest;
    refused_ = 0;
    is_on_ = true;
  }
  /// What the last `begin` remembered; `go_back` leaves its two numbers.
  [[nodiscard]] const WatchdogStart& start() const noexcept { return start_; }
  /// Whether one more step may be taken though it is refused; counts it.
  [[nodiscard]] bool allows_another() noexcept { return ++refused_ <= constants::most_watched_steps; }
  /// Puts the iterate, its values and its step back to those of the start, and ends.
  void go_back(Iterate& at, Evaluation& values, Iterate& step) {
    std::swap(at, start_.at);
    std::swap(values, start_.values);
    std::swap(step, start_.step);
    forget();
  }

 private:
  static void copy(const Iterate& from, Iterate& to) {
    copy_to(to.x, from.x);
    to.s = from.s;
    copy_to(to.multipliers, from.multipliers);
    to.z = from.z;
  }

  WatchdogStart start_;
  int shortened_ = 0;  // searches in a row
  int refused_ = 0;    // steps since the start that were taken all the same
  bool is_on_ = false;
};

}  // namespace dmocbench::interior_point
