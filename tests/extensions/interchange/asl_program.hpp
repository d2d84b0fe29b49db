#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace dmocbench::tests {

/// A sparse matrix by rows and columns.
using SparseEntries = std::map<std::pair<Eigen::Index, Eigen::Index>, double>;

/// How the library reads a program, and by that how it differentiates.
enum class AslReader : std::uint8_t {
  whole,                ///< formulas as they stand (fgh_read); second derivatives direction by direction
  partially_separable,  ///< as sums of parts (pfgh_read), as Ipopt reads; second derivatives part by part
};

/// A nonlinear program as AMPL's library of solvers reads it from STUB.nl.
class AslProgram {
 public:
  /// Throws `Error` if the library refuses the file.
  explicit AslProgram(const std::filesystem::path& file, AslReader reader = AslReader::partially_separable);
  AslProgram(const AslProgram&) = delete;
  AslProgram& operator=(const AslProgram&) = delete;
  ~AslProgram();

  Eigen::Index variables = 0;
  Eigen::Index rows = 0;
  Eigen::VectorXd start;
  Eigen::VectorXd variable_lower;
  Eigen::VectorXd variable_upper;
  Eigen::VectorXd row_lower;
  Eigen::VectorXd row_upper;
  std::vector<std::string> variable_names;
  std::vector<std::string> row_names;

  // These throw `Error` where the library cannot evaluate.
  [[nodiscard]] double objective(const Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::VectorXd gradient(const Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::VectorXd constraints(const Eigen::VectorXd& x) const;
  [[nodiscard]] SparseEntries jacobian(const Eigen::VectorXd& x) const;
  /// The lower triangle.
  [[nodiscard]] SparseEntries hessian(const Eigen::VectorXd& x, double factor,
                                      const Eigen::VectorXd& multipliers) const;

  /// Writes STUB.sol.
  void write_solution(const std::string& message, int code, Eigen::VectorXd x, Eigen::VectorXd duals) const;

 private:
  struct Library;
  [[nodiscard]] SparseEntries hessian_by_directions(double factor, const Eigen::VectorXd& multipliers) const;
  [[nodiscard]] SparseEntries hessian_by_parts(double factor, const Eigen::VectorXd& multipliers) const;

  AslReader reader_;
  std::unique_ptr<Library> library_;
};

}  // namespace dmocbench::tests
