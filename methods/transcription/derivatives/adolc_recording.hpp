#pragma once

#include <cstddef>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <adolc/adolc.h>

#include "methods/error.hpp"

namespace dmocbench {

/// A number under which ADOL-C keeps a recording of ours, far from the numbers that a user would choose. The recording
/// lives as long as this object.
class AdolcTag {
 public:
  /// Takes the first free number. Throws `Error` where too many recordings are swept in reverse: ADOL-C keeps a buffer
  /// for each until it is removed, and one more than 32 (its TBUFNUM) would end the program.
  explicit AdolcTag(bool is_swept_in_reverse) : is_swept_in_reverse_(is_swept_in_reverse) {
    constexpr int most = 32;
    const std::lock_guard lock(mutex());
    if (is_swept_in_reverse_ && swept_in_reverse() == most) {
      throw Error(
          "ADOL-C can differentiate at most 32 recordings in reverse mode, and a program needs two or three; use fewer "
          "programs at a time or another derivative back end");
    }
    swept_in_reverse() += is_swept_in_reverse_ ? 1 : 0;
    while (used().contains(number_)) ++number_;
    used().insert(number_);
  }
  ~AdolcTag() {
    removeTape(number_, ADOLC_REMOVE_COMPLETELY);
    const std::lock_guard lock(mutex());
    swept_in_reverse() -= is_swept_in_reverse_ ? 1 : 0;
    used().erase(number_);
  }
  AdolcTag(const AdolcTag&) = delete;
  AdolcTag& operator=(const AdolcTag&) = delete;

  /// What ADOL-C's functions take.
  [[nodiscard]] short number() const noexcept { return number_; }

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  static std::set<short>& used() {
    static std::set<short> instance;
    return instance;
  }
  static int& swept_in_reverse() {
    static int count = 0;
    return count;
  }
  short number_ = 16384;
  bool is_swept_in_reverse_;
};

/// Throws `Error` if a driver of ADOL-C returned a failure.
inline void require_adolc(int status, const char* driver) {
  if (status < 0) throw Error(std::string("ADOL-C's ") + driver + " failed on the formulas of the program");
}

/// A dense matrix in ADOL-C's format, an array of rows.
class AdolcMatrix {
 public:
  /// All entries are 0.
  AdolcMatrix(int rows, int columns)
      : entries_(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns)),
        rows_(static_cast<std::size_t>(rows)) {
    double* next = entries_.data();
    for (double*& row : rows_) row = std::exchange(next, next + columns);
  }
  /// What ADOL-C's functions take.
  [[nodiscard]] double** rows() { return rows_.data(); }
  /// The entry.
  [[nodiscard]] double& operator()(std::size_t i, std::size_t j) { return rows_[i][j]; }

 private:
  std::vector<double> entries_;
  std::vector<double*> rows_;
};

}  // namespace dmocbench
