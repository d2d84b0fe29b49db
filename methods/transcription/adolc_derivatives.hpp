#pragma once

#include <cstddef>
#include <vector>

#include "methods/transcription/column_assembly.hpp"
#include "methods/transcription/derivative_back_end.hpp"

namespace dmocbench {

/// Exact derivatives by ADOL-C, which differentiates the values of an interval (cost, rows, ℓ).
///
/// Each is recorded once per back end, with constants passive; an evaluation then calls ADOL-C's dense driver interval
/// after interval (`gradient`, `jacobian`, and `hess_mat` in the directions of the local unknowns) and keeps the
/// entries that are not zero for every motion. Step, time, factor and multipliers are further independent variables.
/// ADOL-C allocates in its drivers, and its recordings are global: two threads must not use such back ends at once.
class AdolcDerivatives final : public DerivativeBackEnd {
 public:
  AdolcDerivatives(const LocalFunctions& functions, const DerivativePlaces& places);

  void gradient(Inputs inputs, VectorOut result) override;
  void jacobian(Inputs inputs, VectorOut values) override;
  void hessian(Inputs inputs, VectorOut values) override;

 private:
  /// Formulas that ADOL-C has recorded under their own number.
  class Recording {
   public:
    explicit Recording(const Schedule& schedule);
    ~Recording();
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;
    Recording(Recording&&) = delete;
    Recording& operator=(Recording&&) = delete;

    [[nodiscard]] short tag() const noexcept { return tag_; }
    [[nodiscard]] std::size_t input_count() const noexcept { return point_.size(); }
    [[nodiscard]] std::size_t output_count() const noexcept { return output_count_; }
    /// The inputs of one interval, one after the other.
    [[nodiscard]] double* point(Inputs inputs, std::size_t interval);

   private:
    short tag_;
    std::size_t output_count_;
    std::vector<double> point_;
  };
  /// A dense matrix in ADOL-C's format, an array of rows.
  class Dense {
   public:
    Dense(std::size_t rows, std::size_t columns);
    [[nodiscard]] double** rows() { return rows_.data(); }
    [[nodiscard]] double& operator()(std::size_t i, std::size_t j) { return rows_[i][j]; }

   private:
    std::vector<double> entries_;
    std::vector<double*> rows_;
  };
  struct Position {
    std::size_t row;
    std::size_t column;
  };

  Recording cost_;
  Recording rows_;
  Recording lagrangian_;
  std::vector<std::size_t> gradient_unknowns_;  // per entry
  std::vector<Position> jacobian_positions_;
  std::vector<Position> hessian_positions_;
  ColumnAssembly gradient_;
  ColumnAssembly jacobian_;
  ColumnAssembly hessian_;
  std::vector<double> cost_gradient_;
  Dense rows_jacobian_;
  std::size_t directions_;
  Dense seeds_;
  Dense seeded_hessian_;
};

}  // namespace dmocbench
