#pragma once

namespace dmocbench::kkt {

/// Chooses the refusals of a fast system (`wrong_inertia`) that an exact one checks. The fast test of the inertia may
/// be stricter than the truth. Where it is so at one matrix it often is at the next ones too; each of them is then
/// shifted for nothing, and Newton's method takes many short steps in place of a few.
///
/// - Every fourth refusal of one matrix is checked: a Hessian usually has the right inertia after two or three shifts.
/// - After 32 matrices that were refused, all refusals of the next ones are, until one of them decides: a wrong
///   refusal, or several of one matrix that were right. One alone, mostly of the matrix without a shift, proves
///   little; four such matrices are enough. Where all were right, twice as many matrices are accepted before the next
///   check. Two matrices in a row that are not refused restart the count.
/// - Once a refusal was wrong, all refusals are checked, until matrices show in the same way that they are right.
class RefusalChecks {
 public:
  /// Call before the matrices of another solve.
  void forget() noexcept { *this = {}; }
  /// Call after a refusal; true if it has to be checked.
  [[nodiscard]] bool ask() noexcept {
    ++refusals_;
    return checks_all_ || refusals_ % most_believed == 0;
  }
  /// The refusal that was checked last was wrong.
  void contradict() noexcept { was_wrong_ = true; }
  /// Call after a step; the next matrix is another one.
  void end_matrix() noexcept {
    if (refusals_ > 0) {
      count_refused_matrix();
    } else if (++calm_ >= enough_calm) {
      refused_matrices_ = 0;
    }
    refusals_ = 0;
    was_wrong_ = false;
  }

 private:
  static constexpr int most_believed = 4;
  static constexpr int first_patience = 32;
  static constexpr int enough_calm = 2;
  static constexpr int enough_refused_once = 4;

  void count_refused_matrix() noexcept {
    calm_ = 0;
    ++refused_matrices_;
    if (was_wrong_) {
      patience_ = first_patience;
      refused_once_ = 0;
      checks_all_ = true;
    } else if (checks_all_) {
      if (refusals_ == 1 && ++refused_once_ < enough_refused_once) return;
      refused_once_ = 0;
      patience_ *= 2;
      refused_matrices_ = 0;
      checks_all_ = false;
    } else {
      checks_all_ = refused_matrices_ >= patience_;
    }
  }

  int refusals_ = 0;          // of the present matrix
  bool was_wrong_ = false;    // one of them
  int refused_matrices_ = 0;  // since it was calm, or since all refusals of one were right
  int calm_ = 0;              // matrices in a row that were not refused
  int refused_once_ = 0;      // matrices whose only refusal was checked and right
  int patience_ = first_patience;
  bool checks_all_ = false;
};

}  // namespace dmocbench::kkt
