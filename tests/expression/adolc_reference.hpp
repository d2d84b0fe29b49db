#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>
#include <adolc/adolc.h>

namespace dmocbench::tests {

/// Value and derivatives of a function as ADOL-C finds them: it tapes the operations of plain
/// numbers and knows nothing of our graphs.
class AdolcReference {
 public:
  /// `function` maps a span of adouble to a vector of adouble.
  template <class Function>
  AdolcReference(const Function& function, std::span<const double> point) : point_(point.begin(), point.end()) {
    trace_on(tag);
    {
      std::vector<adouble> inputs(point.size());
      for (std::size_t i = 0; i < point.size(); ++i) inputs[i] <<= point[i];
      std::vector<adouble> outputs = function(std::span<const adouble>(inputs));
      values_.resize(outputs.size());
      for (std::size_t i = 0; i < outputs.size(); ++i) outputs[i] >>= values_[i];
    }
    trace_off();
  }

  [[nodiscard]] const std::vector<double>& values() const { return values_; }

  /// Rows × inputs.
  [[nodiscard]] Eigen::MatrixXd first_derivatives() const {
    Table table(values_.size(), point_.size());
    ::jacobian(tag, static_cast<int>(values_.size()), static_cast<int>(point_.size()), point_.data(),
               table.rows.data());
    return table.entries;
  }

  /// Second derivatives of a function with a single output.
  [[nodiscard]] Eigen::MatrixXd second_derivatives() const {
    Table table(point_.size(), point_.size());
    ::hessian(tag, static_cast<int>(point_.size()), point_.data(), table.rows.data());
    return table.entries.selfadjointView<Eigen::Lower>();
  }

 private:
  static constexpr short tag = 1;

  struct Table {
    Table(std::size_t row_count, std::size_t column_count)
        : entries(Entries::Zero(static_cast<Eigen::Index>(row_count), static_cast<Eigen::Index>(column_count))) {
      for (Eigen::Index i = 0; i < entries.rows(); ++i) rows.push_back(entries.row(i).data());
    }
    using Entries = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Entries entries;
    std::vector<double*> rows;
  };

  mutable std::vector<double> point_;  // the library's drivers take pointers to non-const
  std::vector<double> values_;
};

}  // namespace dmocbench::tests
