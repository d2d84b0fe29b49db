#include "methods/kkt/symmetric_factorisation.hpp"

#include <chrono>
#include <new>
#include <thread>
#include <utility>
#include <vector>

#include <dmumps_c.h>

#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

std::unique_lock<std::recursive_mutex> lock_mumps(const std::function<bool()>& gives_up) {
  static std::recursive_mutex mutex;
  if (!gives_up) return std::unique_lock(mutex);
  std::unique_lock lock(mutex, std::try_to_lock);
  while (!lock && !gives_up()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    lock.try_lock();
  }
  return lock;
}

namespace {

constexpr int job_begin = -1;
constexpr int job_end = -2;
constexpr int job_analyse = 1;
constexpr int job_factorise = 2;
constexpr int job_solve = 3;
constexpr int use_comm_world = -987654;  // the value that its manual prescribes
constexpr int general_symmetric = 2;
constexpr int order_is_given = 1;
constexpr int order_is_found = 7;
constexpr int more_workspace_percent = 100;  // of a given order, for rows whose pivots are postponed

// Numbers of the manual, which counts from 1.
constexpr int control(int number) { return number - 1; }

void call_mumps(DMUMPS_STRUC_C& data, int job) {
  const bool may_stop = job != job_begin && job != job_end;
  const auto lock = lock_mumps(may_stop ? must_stop : nullptr);
  if (!lock) stop_if_requested();
  data.job = job;
  dmumps_c(&data);
}

bool is_singular(int code) { return code == -10 || code == -6; }
bool lacks_workspace(int code) { return code == -8 || code == -9; }
bool lacks_memory(int code) { return code == -7 || code == -13; }

}  // namespace

struct SymmetricFactorisation::Mumps {
  DMUMPS_STRUC_C data{};
  std::vector<MUMPS_INT> rows;
  std::vector<MUMPS_INT> columns;
  std::vector<double> values;
  std::vector<MUMPS_INT> positions;  // from 1 on; empty to let MUMPS choose
  bool analysed = false;

  explicit Mumps(std::vector<MUMPS_INT> order) : positions(std::move(order)) {
    data.par = 1;
    data.sym = general_symmetric;
    data.comm_fortran = use_comm_world;
    call_mumps(data, job_begin);
    for (const int stream : {1, 2, 3}) data.icntl[control(stream)] = -1;
    data.icntl[control(4)] = 0;   // silent
    data.icntl[control(13)] = 1;  // counts negative pivots in the root too
    data.icntl[control(24)] = 1;  // detects pivots that are mere rounding
    if (positions.empty()) return;
    data.icntl[control(7)] = order_is_given;
    data.icntl[control(14)] = more_workspace_percent;  // to start again takes longer
    data.perm_in = positions.data();
  }
  ~Mumps() { call_mumps(data, job_end); }
  Mumps(const Mumps&) = delete;
  Mumps& operator=(const Mumps&) = delete;

  /// False if the matrix is singular. Where workspace is lacking, tries again with more. If a given order lacks it
  /// again, so many pivots are postponed that the order that MUMPS finds takes less time. In that order about ten times
  /// as much as the pattern needs is the limit: pivots that are postponed so often make minutes of a millisecond.
  /// Throws `std::bad_alloc` where memory is lacking, `Stopped`, `Error` otherwise.
  bool run(int job) {
    constexpr int most_workspace_percent = 1000;
    while (true) {
      call_mumps(data, job);
      const int code = data.infog[control(1)];
      if (code >= 0) return true;
      const bool is_enough = data.icntl[control(14)] >= most_workspace_percent;
      if (is_singular(code) || (lacks_workspace(code) && is_enough)) return false;
      if (lacks_memory(code)) throw std::bad_alloc();
      if (!lacks_workspace(code)) throw Error("MUMPS failed with code {}; the MUMPS manual lists the codes", code);
      stop_if_requested();
      if (positions.empty() || data.icntl[control(14)] == more_workspace_percent) {
        data.icntl[control(14)] *= 4;
      } else if (!finds_order()) {
        return false;
      }
    }
  }

  /// Replaces the given order; false if the matrix is singular.
  bool finds_order() {
    positions.clear();
    data.icntl[control(7)] = order_is_found;
    require_time_to_analyse();
    return run(job_analyse);
  }

  /// Throws `Stopped` where the time left is too short to choose an order: MUMPS cannot be stopped meanwhile.
  void require_time_to_analyse() const {
    constexpr double seconds_per_entry = 2e-6;
    if (!positions.empty() || !(seconds_left() < seconds_per_entry * static_cast<double>(values.size()))) return;
    throw Stopped("the remaining time is too short to choose an elimination order");
  }

  /// True if the pattern differs from the one analysed.
  bool read(const Eigen::SparseMatrix<double>& lower) {
    std::vector<MUMPS_INT> new_rows;
    std::vector<MUMPS_INT> new_columns;
    values.clear();
    for (Eigen::Index j = 0; j < lower.outerSize(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, j); entry; ++entry) {
        new_rows.push_back(static_cast<MUMPS_INT>(entry.row() + 1));
        new_columns.push_back(static_cast<MUMPS_INT>(entry.col() + 1));
        values.push_back(entry.value());
      }
    }
    const bool changed = !analysed || new_rows != rows || new_columns != columns;
    rows = std::move(new_rows);
    columns = std::move(new_columns);
    data.n = static_cast<MUMPS_INT>(lower.rows());
    data.nnz = static_cast<MUMPS_INT8>(values.size());
    data.irn = rows.data();
    data.jcn = columns.data();
    data.a = values.data();
    return changed;
  }
};

SymmetricFactorisation::SymmetricFactorisation(const std::vector<int>& positions) {
  std::vector<MUMPS_INT> from_one;
  for (const int position : positions) from_one.push_back(static_cast<MUMPS_INT>(position + 1));
  mumps_ = std::make_shared<Mumps>(std::move(from_one));
}

bool SymmetricFactorisation::factorise(const Eigen::SparseMatrix<double>& lower) {
  if (!(lower.coeffs().abs() <= largest_entry).all()) return false;  // NaN fails it too
  try {
    // An analysis reads values as well, for its scaling and matching. One of a singular matrix, or of other values,
    // finds pivots that are mere rounding in a matrix that is regular.
    bool analyses = mumps_->read(lower);
    while (true) {
      if (analyses) mumps_->require_time_to_analyse();
      if (analyses) mumps_->analysed = mumps_->run(job_analyse);
      if (analyses && !mumps_->analysed) return false;
      if (mumps_->run(job_factorise) && mumps_->data.infog[control(28)] == 0) return true;
      mumps_->analysed = false;
      if (analyses) return false;
      analyses = true;
    }
  } catch (...) {  // its work is half done
    mumps_ = std::make_shared<Mumps>(std::move(mumps_->positions));
    throw;
  }
}

Eigen::Index SymmetricFactorisation::negative_eigenvalues() const { return mumps_->data.infog[control(12)]; }

Eigen::VectorXd SymmetricFactorisation::solve(Eigen::VectorXd right_hand_side) {
  mumps_->data.rhs = right_hand_side.data();
  mumps_->data.nrhs = 1;
  mumps_->data.lrhs = static_cast<MUMPS_INT>(right_hand_side.size());
  static_cast<void>(mumps_->run(job_solve));
  return right_hand_side;
}

}  // namespace dmocbench
