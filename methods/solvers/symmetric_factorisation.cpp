#include "methods/solvers/symmetric_factorisation.hpp"

#include <utility>
#include <vector>

#include <dmumps_c.h>
#include <fmt/format.h>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

constexpr int job_begin = -1;
constexpr int job_end = -2;
constexpr int job_analyse = 1;
constexpr int job_factorise = 2;
constexpr int job_solve = 3;
constexpr int use_comm_world = -987654;  // the value that its manual prescribes
constexpr int general_symmetric = 2;
constexpr int order_is_given = 1;

// Numbers of the manual, which counts from 1.
constexpr int control(int number) { return number - 1; }

bool is_singular(int info) { return info == -10 || info == -6; }
bool lacks_workspace(int info) { return info == -8 || info == -9; }

}  // namespace

struct SymmetricFactorisation::Mumps {
  DMUMPS_STRUC_C data{};
  std::vector<MUMPS_INT> rows;
  std::vector<MUMPS_INT> columns;
  std::vector<double> values;
  std::vector<MUMPS_INT> positions;  // from 1 on; empty to let MUMPS choose
  bool analysed = false;

  Mumps() {
    data.job = job_begin;
    data.par = 1;
    data.sym = general_symmetric;
    data.comm_fortran = use_comm_world;
    dmumps_c(&data);
    for (const int stream : {1, 2, 3}) data.icntl[control(stream)] = -1;
    data.icntl[control(4)] = 0;   // silent
    data.icntl[control(13)] = 1;  // counts negative pivots in the root too
    data.icntl[control(24)] = 1;  // detects pivots that are mere rounding
  }
  ~Mumps() {
    data.job = job_end;
    dmumps_c(&data);
  }
  Mumps(const Mumps&) = delete;
  Mumps& operator=(const Mumps&) = delete;
  Mumps(Mumps&&) = delete;
  Mumps& operator=(Mumps&&) = delete;

  int run(int job) {
    data.job = job;
    dmumps_c(&data);
    return data.infog[control(1)];
  }

  [[noreturn]] static void fail(int info) {
    throw Error(fmt::format("MUMPS failed with code {}; its manual lists the codes", info));
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

SymmetricFactorisation::SymmetricFactorisation() : mumps_(std::make_unique<Mumps>()) {}
SymmetricFactorisation::SymmetricFactorisation(const std::vector<int>& positions) : SymmetricFactorisation() {
  constexpr int more_workspace_percent = 100;  // for rows whose pivots are postponed; to start again takes longer
  for (const int position : positions) mumps_->positions.push_back(static_cast<MUMPS_INT>(position + 1));
  if (positions.empty()) return;
  mumps_->data.icntl[control(7)] = order_is_given;
  mumps_->data.icntl[control(14)] = more_workspace_percent;
  mumps_->data.perm_in = mumps_->positions.data();
}
SymmetricFactorisation::~SymmetricFactorisation() = default;
SymmetricFactorisation::SymmetricFactorisation(SymmetricFactorisation&&) noexcept = default;
SymmetricFactorisation& SymmetricFactorisation::operator=(SymmetricFactorisation&&) noexcept = default;

bool SymmetricFactorisation::factorise(const Eigen::SparseMatrix<double>& lower) {
  if (mumps_->read(lower)) {
    const int info = mumps_->run(job_analyse);
    if (is_singular(info)) return false;
    if (info < 0) Mumps::fail(info);
    mumps_->analysed = true;
  }
  constexpr int most_workspace_percent = 10'000;
  int info = mumps_->run(job_factorise);
  while (lacks_workspace(info) && mumps_->data.icntl[control(14)] < most_workspace_percent) {
    mumps_->data.icntl[control(14)] *= 4;
    info = mumps_->run(job_factorise);
  }
  if (is_singular(info)) return false;
  if (info < 0) Mumps::fail(info);
  const bool has_full_rank = mumps_->data.infog[control(28)] == 0;
  return has_full_rank;
}

Eigen::Index SymmetricFactorisation::negative_eigenvalues() const { return mumps_->data.infog[control(12)]; }

double SymmetricFactorisation::floating_point_operations() const { return mumps_->data.rinfog[control(3)]; }

Eigen::VectorXd SymmetricFactorisation::solve(Eigen::VectorXd right_hand_side) {
  mumps_->data.rhs = right_hand_side.data();
  mumps_->data.nrhs = 1;
  mumps_->data.lrhs = static_cast<MUMPS_INT>(right_hand_side.size());
  const int info = mumps_->run(job_solve);
  if (info < 0) Mumps::fail(info);
  return right_hand_side;
}

}  // namespace dmocbench
