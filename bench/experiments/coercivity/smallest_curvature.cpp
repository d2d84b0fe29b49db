#include "bench/experiments/coercivity/smallest_curvature.hpp"

#include <cmath>
#include <vector>

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
  ShiftedKkt(Transcription& program, const Solution& solution)
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
  /// h b_i for the controls of stage i, in the units of the scaled cost; 0 elsewhere.
  [[nodiscard]] static Eigen::VectorXd weights_of(const Transcription& program, const Eigen::VectorXd& x) {
    const Tableau& controls = program.functions().controls;
    if (controls.shares_controls) throw Error("coercivity needs controls that no two stages share");
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

std::optional<double> smallest_curvature(Transcription& program, const Solution& solution) {
  constexpr double smallest = 1e-9;
  constexpr double largest = 1e12;
  constexpr double digits = 1e-6;
  ShiftedKkt kkt(program, solution);
  if (!kkt.is_positive_beyond(-smallest)) return std::nullopt;
  if (!kkt.is_positive_beyond(smallest)) return 0.0;
  double low = smallest;
  while (low < largest && kkt.is_positive_beyond(10.0 * low)) low *= 10.0;
  double high = 10.0 * low;
  while (high > low * (1.0 + digits)) {
    const double middle = std::sqrt(low * high);
    (kkt.is_positive_beyond(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace dmocbench
