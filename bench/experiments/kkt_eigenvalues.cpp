#include "bench/experiments/kkt_eigenvalues.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <lapacke.h>

#include "methods/error.hpp"
#include "methods/kkt/linearisation.hpp"
#include "methods/kkt/symmetric_factorisation.hpp"

namespace dmocbench {

namespace {

/// Closer to its bound a variable or a constraint is active.
constexpr double at_bound = 1e-8;

bool is_active(double value, double lower, double upper) { return std::min(value - lower, upper - value) < at_bound; }

/// The KKT matrix at a solution, with multiples of the controls' weights taken off.
class ShiftedKkt {
 public:
  ShiftedKkt(Transcription& program, const Solution& solution, EndVariation end)
      : hessian_(hessian_at(program, solution.primal, solution.multipliers)),
        free_(free_variables(program)),
        counts_(equalities_of(program)),
        weights_(weights_of(program, solution.primal)) {
    Linearisation at = values_at(program, solution.primal);
    differentiate(program, at);
    jacobian_ = at.jacobian;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      counts_[i] = counts_[i] ||
                   is_active(at.constraints[row], program.constraint_lower()[row], program.constraint_upper()[row]);
    }
    for (std::size_t j = 0; j < free_.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      free_[j] = free_[j] && !is_active(solution.primal[column], program.variable_lower()[column],
                                        program.variable_upper()[column]);
    }
    if (end == EndVariation::free) free_last_node(*program.interval_structure());
  }

  /// Whether the form without α times the weights is positive definite on the null space of the equations.
  [[nodiscard]] bool is_positive_beyond(double alpha) {
    Eigen::SparseMatrix<double> shift(hessian_.rows(), hessian_.cols());
    shift.reserve(Eigen::VectorXi::Ones(hessian_.cols()));
    for (Eigen::Index j = 0; j < weights_.size(); ++j) shift.insert(j, j) = -alpha * weights_[j];
    const Eigen::SparseMatrix<double> shifted = hessian_ + shift;
    return factors_.factorise(kkt_matrix(shifted, 0.0, jacobian_, free_, counts_)) &&
           factors_.negative_eigenvalues() == jacobian_.rows();
  }

 private:
  void free_last_node(const IntervalStructure& structure) {
    const auto set_last = [&](const Places& places, std::vector<bool>& flags, bool flag) {
      for (std::size_t i = 0; i < flags.size(); ++i) {
        const Place place = places[i];
        if (place.kind == Place::Kind::node && place.index == structure.intervals) flags[i] = flag;
      }
    };
    set_last(structure.unknowns, free_, true);
    set_last(structure.rows, counts_, false);
  }
  /// h b_i for the controls of stage i, in the units of the scaled cost; 0 elsewhere.
  [[nodiscard]] static Eigen::VectorXd weights_of(const Transcription& program, const Eigen::VectorXd& x) {
    const Tableau& controls = program.functions().controls;
    if (controls.shares_controls) throw Error("coercivity needs controls that are not shared between stages");
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(x.size());
    const Eigen::VectorXd steps = program.steps(x);
    const ProgramBlocks& blocks = program.blocks();
    for (Eigen::Index i = 0; i < controls.stages(); ++i) {
      for (Eigen::Index j = 0; j < program.traced_problem().control_size(); ++j) {
        const auto first = blocks.unknown(Quantity::control, i).index(j);
        weights.segment(first, steps.size()) = program.cost_scale() * controls.b[i] * steps;
      }
    }
    return weights;
  }

  Eigen::SparseMatrix<double> hessian_;
  Eigen::SparseMatrix<double> jacobian_;
  std::vector<bool> free_;
  std::vector<bool> counts_;
  Eigen::VectorXd weights_;
  SymmetricFactorisation factors_;
};

}  // namespace

std::optional<double> smallest_curvature(Transcription& program, const Solution& solution, EndVariation end) {
  constexpr double smallest = 1e-9;
  constexpr double largest = 1e12;
  constexpr double digits = 1e-6;
  ShiftedKkt kkt(program, solution, end);
  const bool is_nonnegative = kkt.is_positive_beyond(-smallest);
  if (is_nonnegative && !kkt.is_positive_beyond(smallest)) return 0.0;
  // |α| lies between two numbers, of which the form without α times the weights is definite at one alone.
  const double sign = is_nonnegative ? 1.0 : -1.0;
  const auto is_below = [&](double size) { return kkt.is_positive_beyond(sign * size) == is_nonnegative; };
  double low = smallest;
  while (low < largest && is_below(10.0 * low)) low *= 10.0;
  if (!is_nonnegative && low >= largest) return std::nullopt;
  double high = 10.0 * low;
  while (high > low * (1.0 + digits)) {
    const double middle = std::sqrt(low * high);
    (is_below(middle) ? low : high) = middle;
  }
  return sign * low;
}

namespace {

/// In ascending order; the lower triangle of the matrix is read.
Eigen::VectorXd eigenvalues(Eigen::MatrixXd symmetric) {
  const auto size = static_cast<lapack_int>(symmetric.rows());
  Eigen::VectorXd values(symmetric.rows());
  if (LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'N', 'L', size, symmetric.data(), size, values.data()) != 0) {
    throw Error("the eigenvalues of a symmetric matrix cannot be computed because an entry is not a number");
  }
  return values;
}

/// Throws `Error` if more holds than the equations.
void require_no_active_inequality(const NonlinearProgram& program, const Linearisation& at,
                                  const std::vector<bool>& free, const std::vector<bool>& equalities) {
  bool has_active = false;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    has_active |= free[i] && is_active(at.point[j], program.variable_lower()[j], program.variable_upper()[j]);
  }
  for (std::size_t i = 0; i < equalities.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    has_active |=
        !equalities[i] && is_active(at.constraints[j], program.constraint_lower()[j], program.constraint_upper()[j]);
  }
  if (has_active) throw Error("the condition number is defined only if no bound is active, but a bound is active");
}

/// Divides rows and columns of a symmetric matrix by the roots of their largest entries until all of these are 1.
void equilibrate(Eigen::MatrixXd& matrix) {
  constexpr int passes = 40;  // each brings the largest entries nearer to 1 by the square root
  for (int pass = 0; pass < passes; ++pass) {
    const Eigen::VectorXd scale = matrix.cwiseAbs().rowwise().maxCoeff().cwiseSqrt().cwiseInverse();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) matrix.col(j).array() *= scale.array() * scale[j];
  }
}

}  // namespace

std::optional<double> kkt_condition(NonlinearProgram& program, const Solution& solution) {
  Linearisation at = values_at(program, solution.primal);
  differentiate(program, at);
  const std::vector<bool> free = free_variables(program);
  const std::vector<bool> equalities = equalities_of(program);
  require_no_active_inequality(program, at, free, equalities);
  // Unit rows stand for the variables and rows left out: their eigenvalues are between the others.
  const Eigen::SparseMatrix<double> lower =
      kkt_matrix(hessian_at(program, solution.primal, solution.multipliers), 0.0, at.jacobian, free, equalities);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(lower.rows(), lower.cols());
  for (Eigen::Index j = 0; j < lower.cols(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, j); entry; ++entry) {
      matrix(entry.row(), j) = entry.value();
      matrix(j, entry.row()) = entry.value();
    }
  }
  equilibrate(matrix);
  if (!matrix.allFinite()) return std::nullopt;  // a row of zeros
  const Eigen::VectorXd magnitudes = eigenvalues(std::move(matrix)).cwiseAbs();
  const double condition = magnitudes.maxCoeff() / magnitudes.minCoeff();
  return std::isfinite(condition) ? std::optional(condition) : std::nullopt;
}

}  // namespace dmocbench
