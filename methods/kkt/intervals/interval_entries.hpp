#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "methods/kkt/intervals/segment_kernel.hpp"
#include "methods/kkt/intervals/shape.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::kkt {

/// An entry of an interval's blocks in natural order: unknowns (x_{k+1}, y_k, x_k, s_k, θ), equalities (first of node
/// k, then the interval's own).
struct LocalEntry {
  enum class Block : unsigned char { equality, carry, hessian, inequality };
  Block block;
  int row;
  int column;
  Source source;
  Eigen::Index first;  ///< the entry of interval k stands at `first` + k
};

/// An entry of the KKT matrix that belongs to the ends of the horizon: between rows and unknowns of the first and the
/// last node and of the border.
struct EndEntry {
  Source source;  ///< hessian or jacobian
  Eigen::Index entry;
  Eigen::Index row;     ///< of the program: an unknown (hessian) or a row (jacobian)
  Eigen::Index column;  ///< of the program: an unknown
};

/// Derivatives that only the intervals from `begin` on have, `length` of them. They are copied to the array of padded
/// ones, N entries from `padded_first` on, zero elsewhere.
struct PaddedRun {
  Source source;
  Eigen::Index entry;
  Eigen::Index begin;
  Eigen::Index length;
  Eigen::Index padded_first;
};

/// The entries of a program that belong to its intervals, and to the ends.
struct IntervalEntries {
  Shape shape{};
  Eigen::Index intervals = 0;

  // The first of an unknown, or of a row, of all nodes or intervals: it stands at first + k for node or interval k.
  std::vector<Eigen::Index> node_unknowns;
  std::vector<Eigen::Index> interval_unknowns;
  std::vector<Eigen::Index> equality_rows;  ///< of nodes, then of intervals
  std::vector<Eigen::Index> inequality_rows;
  std::vector<bool> is_fixed;               ///< one per unknown of an interval
  std::vector<Eigen::Index> held_unknowns;  ///< fixed ones of nodes between the ends, by their numbers in the program

  std::vector<Eigen::Index> global_unknowns;
  std::array<std::vector<Eigen::Index>, 2> end_unknowns;  ///< further unknowns of the first and of the last node
  std::vector<Eigen::Index> end_rows;                     ///< further rows of the ends, and rows of the border
  std::vector<LocalEntry> local;
  std::vector<PaddedRun> padded;
  std::vector<EndEntry> ends;

  /// The number of the unknown that interval 0 has in a column of its blocks; s_k has none.
  [[nodiscard]] Eigen::Index unknown_in(int column) const;
  /// Whether a column belongs to a fixed unknown of an interval.
  [[nodiscard]] bool is_fixed_column(int column) const;

  // For arrays with `width` numbers per entry, one of each program.
  /// The array of padded derivatives, zeros.
  [[nodiscard]] Eigen::VectorXd make_padded(Eigen::Index width) const;
  void copy_padded(const NewtonArrays& arrays, Eigen::Index width, Eigen::VectorXd& to) const;
  /// The steps of fixed unknowns, which are zero.
  void write_fixed(Eigen::Index width, double* primal) const;
  /// (J δx + constraints) / e for the rows of every inequality. Unknowns of the whole horizon require width 1.
  void write_inequality_multipliers(const NewtonArrays& arrays, Eigen::Index width, const double* primal,
                                    double* multipliers) const;
};

/// Looks up where a program's runs go. The reason instead if the program has no interval structure, or one that is not
/// the same in all intervals.
[[nodiscard]] tl::expected<IntervalEntries, std::string> interval_entries(const NonlinearProgram& program);

/// The reason why not only the states of both ends are given, or more is stated there; null if it is so.
[[nodiscard]] const char* reason_of_free_ends(const NonlinearProgram& program, const IntervalEntries& entries);

}  // namespace dmocbench::kkt
