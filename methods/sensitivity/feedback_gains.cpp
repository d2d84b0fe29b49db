#include "methods/sensitivity/feedback_gains.hpp"

#include <string>
#include <vector>

#include <Eigen/QR>

#include "methods/error.hpp"
#include "methods/judgement/linearised_conditions.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

/// `count` columns of Q of QR = A, from column `first` on.
Eigen::MatrixXd columns_of_q(const Eigen::MatrixXd& a, Eigen::Index first, Eigen::Index count) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(a);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(a.rows(), count);
  columns.middleRows(first, count).setIdentity();
  columns.applyOnTheLeft(factors.householderQ());
  return columns;
}

/// An orthonormal basis of the x with A x = 0 for r × c A of rank r < c: c × (c - r), by Householder's QR of Aᵀ, whose
/// columns are first brought to length 1.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& a) {
  return columns_of_q(a.transpose().colwise().normalized(), a.rows(), a.cols() - a.rows());
}

/// The last pivot of QR with column pivoting over the first, in absolute value: about 1/condition of a square A, 0 of a
/// singular one up to rounding.
double pivot_ratio(const Eigen::MatrixXd& a) {
  const Eigen::VectorXd pivots = a.colPivHouseholderQr().matrixQR().diagonal().cwiseAbs();
  return pivots[0] > 0.0 ? pivots[pivots.size() - 1] / pivots[0] : 0.0;
}

/// An orthonormal basis of the space that the columns of A span; r × c A has rank c <= r.
Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& a) { return columns_of_q(a, 0, a.cols()); }

/// Deviations of state and costate of a node along which the conditions after it hold: 2n × 2n each, a column per
/// deviation. The state is (q, p), or (q, v) for tangent-space collocation; the costate its conjugate, for the scaled
/// cost.
struct Deviations {
  Eigen::MatrixXd state;
  Eigen::MatrixXd costate;
};

/// Deviations of the state whose pivots are below this share of the largest depend on each other up to rounding.
constexpr double smallest_pivot_ratio = 1e-11;

void require_feedback(const Transcription& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers) {
  if (static_cast<std::size_t>(primal.size()) != program.variable_count() ||
      static_cast<std::size_t>(multipliers.size()) != program.constraint_count()) {
    throw Error("feedback gains need the variables and multipliers of a solution of the same program");
  }
  const IntervalFunctions& functions = program.functions();
  const TracedProblem& traced = program.traced_problem();
  const bool has_own_times = !functions.controls.has_times_of(program.tableau());
  const char* reason = functions.free_horizon                  ? "a free horizon"
                       : traced.boundary_condition_count() > 0 ? "boundary conditions"
                       : functions.controls.shares_controls    ? "controls shared by two intervals"
                       : has_own_times                         ? "controls at times other than the stages"
                       : functions.mayer                       ? "the Mayer form"
                       : traced.integral_count() > 0           ? "integral constraints"
                       : traced.first_order_size() > 0         ? "first-order states"
                       : traced.unknown_count() > 0            ? "unknown parameters"
                       : functions.multipliers > 0             ? "constraints of the trajectory"
                       : program.interval_structure()->has_interior_equations ? "conditions between the ends"
                                                                              : nullptr;
  if (reason != nullptr) {
    throw Error(std::string("feedback gains are not available with ") + reason +
                ": the state at a node alone does not determine the optimal control");
  }
}

/// The symmetric matrix (H, Jᵀ; J, 0) of a part, from row k of the tables of its Hessian and Jacobian.
Eigen::MatrixXd conditions_matrix(const LocalFunctions& functions, const Eigen::MatrixXd& hessian,
                                  const Eigen::MatrixXd& jacobian, Eigen::Index k) {
  const auto unknowns = static_cast<Eigen::Index>(functions.inputs.unknowns);
  const auto size = unknowns + static_cast<Eigen::Index>(functions.inputs.rows);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  const auto add = [&](Eigen::Index i, Eigen::Index j, double value) {
    matrix(i, j) += value;
    if (i != j) matrix(j, i) += value;
  };
  functions.hessian.for_each([&](Eigen::Index e, Eigen::Index i, Eigen::Index j) { add(i, j, hessian(k, e)); });
  functions.jacobian.for_each(
      [&](Eigen::Index e, Eigen::Index r, Eigen::Index j) { add(unknowns + r, j, jacobian(k, e)); });
  return matrix;
}

/// Linear equations in named groups of unknowns, for computing their null space.
class Equations {
 public:
  Equations(Eigen::Index rows, Eigen::Index columns) : matrix_(Eigen::MatrixXd::Zero(rows, columns)) {}
  /// The block of coefficients from (row, column) on.
  template <class Block>
  void add(Eigen::Index row, Eigen::Index column, const Block& block) {
    matrix_.block(row, column, block.rows(), block.cols()) += block;
  }
  /// Equation `row` becomes: unknown `column` is 0.
  void fix(Eigen::Index row, Eigen::Index column) {
    matrix_.row(row).setZero();
    matrix_(row, column) = 1.0;
  }
  [[nodiscard]] Eigen::MatrixXd solutions() const { return null_space(matrix_); }

 private:
  Eigen::MatrixXd matrix_;
};

Eigen::MatrixXd unit(Eigen::Index n, double factor = 1.0) { return factor * Eigen::MatrixXd::Identity(n, n); }

/// The recursion over the intervals of a program.
class BackwardRecursion {
 public:
  BackwardRecursion(Transcription& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers)
      : program_(program),
        blocks_(program.blocks()),
        n_(program.traced_problem().configuration_size()),
        is_dmoc_(program.node_state() == NodeState::configuration),
        conditions_(program, primal, multipliers),
        hessians_(program.tabulate(program.functions().hessian.schedule, primal, multipliers)),
        jacobians_(program.tabulate(program.functions().jacobian.schedule, primal)),
        primal_(primal),
        multipliers_(multipliers) {}

  /// The deviations at the last node.
  [[nodiscard]] Deviations at_end();
  /// Replaces the deviations at node k + 1 by the ones at node k. Returns the controls that belong to them: s m rows.
  [[nodiscard]] Eigen::MatrixXd step_back(Eigen::Index k, Deviations& deviations) const;

 private:
  /// The term that the bounds of a variable add to the diagonal.
  [[nodiscard]] double stiffness(Eigen::Index variable) const {
    return is_fixed(program_, variable) ? 0.0 : conditions_.diagonal[variable];
  }
  [[nodiscard]] Eigen::MatrixXd matrix_of_interval(Eigen::Index k) const;
  [[nodiscard]] Eigen::MatrixXd matrix_of_ends();
  /// Writes the columns of the unknowns `from` .. `from` + `count` of a matrix of conditions into the columns from
  /// `column` on.
  static void add_columns(const Eigen::MatrixXd& matrix, Eigen::Index from, Eigen::Index count, Eigen::Index column,
                          Equations& equations) {
    equations.add(0, column, matrix.middleCols(from, count));
  }

  Transcription& program_;
  const ProgramBlocks& blocks_;
  Eigen::Index n_;
  bool is_dmoc_;
  LinearisedConditions conditions_;
  Eigen::MatrixXd hessians_;
  Eigen::MatrixXd jacobians_;
  const Eigen::VectorXd& primal_;
  const Eigen::VectorXd& multipliers_;
};

/// Includes the stiffness of bounds at its left node and inside, and the compliance of its inequalities.
Eigen::MatrixXd BackwardRecursion::matrix_of_interval(Eigen::Index k) const {
  const IntervalFunctions& functions = program_.functions();
  Eigen::MatrixXd matrix = conditions_matrix(functions, hessians_, jacobians_, k);
  const auto unknowns = static_cast<Eigen::Index>(functions.inputs.unknowns);
  const Eigen::Index node = is_dmoc_ ? n_ : 2 * n_;
  for (Eigen::Index j = 0; j < unknowns; ++j) {
    if (j >= node && j < 2 * node) continue;  // of the right node
    matrix(j, j) += stiffness(index_of(blocks_.unknown_places(), j, k));
  }
  for (Eigen::Index r = 0; r < static_cast<Eigen::Index>(functions.inputs.rows); ++r) {
    matrix(unknowns + r, unknowns + r) -= conditions_.compliance[index_of(blocks_.row_places(), r, k)];
  }
  return matrix;
}

Eigen::MatrixXd BackwardRecursion::step_back(Eigen::Index k, Deviations& deviations) const {
  const Eigen::MatrixXd matrix = matrix_of_interval(k);
  const auto unknowns = static_cast<Eigen::Index>(program_.functions().inputs.unknowns);
  const Eigen::Index node = is_dmoc_ ? n_ : 2 * n_;
  const Eigen::Index size = matrix.rows();
  const Eigen::Index inner = unknowns - 2 * node;
  const Eigen::Index first_row = unknowns + (is_dmoc_ ? 2 * n_ : 0);  // of the interval's own rows
  // Unknowns: (δx_k, δψ_k), the weights c of the deviations at node k + 1, inner unknowns, multipliers of own rows.
  const Eigen::Index states = 2 * n_;
  const Eigen::Index weights = 2 * states;
  const Eigen::Index inside = 3 * states;
  const Eigen::Index own = inside + inner;
  Equations equations(size, own + size - first_row);
  add_columns(matrix, 0, node, 0, equations);
  equations.add(0, weights, matrix.middleCols(node, node) * deviations.state.topRows(node));
  add_columns(matrix, 2 * node, inner, inside, equations);
  add_columns(matrix, first_row, size - first_row, own, equations);
  equations.add(0, states, unit(node, -1.0));                      // ∂ℓ/∂x_k = ψ_k
  equations.add(node, weights, deviations.costate.topRows(node));  // ∂ℓ/∂x_{k+1} = -ψ_{k+1}
  if (is_dmoc_) {
    // The rows at the nodes are ∓p, their multipliers ψ^p.
    add_columns(matrix, unknowns, n_, states + n_, equations);
    equations.add(0, weights, matrix.middleCols(unknowns + n_, n_) * deviations.costate.bottomRows(n_));
    equations.add(unknowns, n_, unit(n_));
    equations.add(unknowns + n_, weights, -deviations.state.bottomRows(n_));
  }
  for (Eigen::Index j = 0; j < inner; ++j) {
    if (is_fixed(program_, index_of(blocks_.unknown_places(), 2 * node + j, k)))
      equations.fix(2 * node + j, inside + j);
  }
  const Eigen::MatrixXd solutions = equations.solutions();
  deviations = {solutions.topRows(states), solutions.middleRows(states, states)};
  const Eigen::Index controls = program_.tableau().stages() * program_.traced_problem().control_size();
  return solutions.middleRows(inside + inner - controls, controls);
}

/// (H, Jᵀ; J, 0) of the ends, without entries where they add nothing to the program.
Eigen::MatrixXd BackwardRecursion::matrix_of_ends() {
  const auto& ends = program_.end_functions();
  if (!ends) return {};
  const auto unknowns = static_cast<Eigen::Index>(ends->inputs.unknowns);
  const auto rows = static_cast<Eigen::Index>(ends->inputs.rows);
  Eigen::VectorXd inputs = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(ends->inputs.count()));
  for (Eigen::Index j = 0; j < unknowns; ++j) inputs[j] = primal_[index_of(blocks_.end_unknown_places(), j, 0)];
  inputs[static_cast<Eigen::Index>(ends->inputs.objective_factor())] = 1.0;
  for (Eigen::Index r = 0; r < rows; ++r) {
    inputs[static_cast<Eigen::Index>(ends->inputs.multiplier(static_cast<std::size_t>(r)))] =
        multipliers_[index_of(blocks_.end_row_places(), r, 0)];
  }
  std::vector<Tape::Input> bound;
  for (const double& input : inputs) bound.push_back({&input});
  const auto values = [&](const Schedule& schedule) { return Tape(schedule).table(1, bound); };
  return conditions_matrix(*ends, values(ends->hessian.schedule), values(ends->jacobian.schedule), 0);
}

Deviations BackwardRecursion::at_end() {
  const Eigen::MatrixXd ends = matrix_of_ends();
  const Eigen::Index node = is_dmoc_ ? n_ : 2 * n_;
  const Eigen::Index first_velocity = blocks_.unknown_at(Quantity::velocity, 0).width;
  const Eigen::Index velocity = blocks_.unknown_at(Quantity::velocity, blocks_.intervals()).width;
  const Eigen::Index ties = velocity;            // rows
  const Eigen::Index own = is_dmoc_ ? 0 : ties;  // whose multipliers are not costates
  const Eigen::Index states = 2 * n_;
  // Unknowns: (δx_N, δψ_N), δv_N, multipliers of own rows. Where DMOC's end is clamped, its momentum is fixed.
  const bool has_fixed_momentum = is_dmoc_ && velocity == 0;
  Equations equations(node + velocity + ties + (has_fixed_momentum ? n_ : 0), 2 * states + velocity + own);
  const Eigen::Index tie = node + velocity;
  if (const auto& functions = program_.end_functions()) {
    const Eigen::Index first = node + first_velocity;  // unknowns of the first end
    const auto unknowns = static_cast<Eigen::Index>(functions->inputs.unknowns);
    const Eigen::Index first_tie = unknowns + first_velocity;
    const auto block = [&](Eigen::Index row, Eigen::Index rows, Eigen::Index column, Eigen::Index columns) {
      return ends.block(row, column, rows, columns);
    };
    equations.add(0, 0, block(first, node + velocity, first, node));
    equations.add(0, 2 * states, block(first, node + velocity, first + node, velocity));
    equations.add(tie, 0, block(first_tie, ties, first, node));
    equations.add(tie, 2 * states, block(first_tie, ties, first + node, velocity));
    equations.add(0, is_dmoc_ ? states + n_ : 2 * states + velocity, block(first, node + velocity, first_tie, ties));
  }
  if (is_dmoc_) equations.add(tie, n_, unit(n_));  // δp_N
  equations.add(0, states, unit(node, -1.0));
  for (Eigen::Index j = 0; j < node + velocity; ++j) {
    const Eigen::Index variable = index_of(blocks_.end_unknown_places(), node + first_velocity + j, 0);
    const Eigen::Index column = j < node ? j : 2 * states + j - node;
    if (is_fixed(program_, variable)) {
      equations.fix(j, column);
    } else {
      equations.add(j, column, Eigen::MatrixXd::Constant(1, 1, stiffness(variable)));
    }
  }
  const Eigen::MatrixXd solutions = equations.solutions();
  return {solutions.topRows(states), solutions.middleRows(states, states)};
}

/// Gains in (q, v) as gains in (q, p).
Eigen::MatrixXd in_momenta(const Eigen::MatrixXd& gains, const Eigen::MatrixXd& mass,
                           const Eigen::MatrixXd& momentum_by_configuration) {
  const Eigen::Index n = mass.rows();
  Eigen::MatrixXd result(gains.rows(), gains.cols());
  const Eigen::MatrixXd by_momentum =
      solve_square(Eigen::MatrixXd(mass.transpose()), Eigen::MatrixXd(gains.rightCols(n).transpose())).transpose();
  result << gains.leftCols(n) - by_momentum * momentum_by_configuration, by_momentum;
  return result;
}

}  // namespace

FeedbackGains feedback_gains(Transcription& program, const Eigen::VectorXd& primal,
                             const Eigen::VectorXd& multipliers) {
  require_feedback(program, primal, multipliers);
  const Trajectory trajectory = read_trajectory(program, primal, Eigen::VectorXd());
  LegendreTransform legendre(program.traced_problem());
  BackwardRecursion recursion(program, primal, multipliers);
  const Eigen::Index s = trajectory.stages();
  const Eigen::Index m = program.traced_problem().control_size();
  FeedbackGains gains;
  gains.of_stages.resize(static_cast<std::size_t>(trajectory.intervals() * s));
  Deviations deviations = recursion.at_end();
  for (Eigen::Index k = trajectory.intervals() - 1; k >= 0; --k) {
    const Eigen::MatrixXd controls = recursion.step_back(k, deviations);
    if (pivot_ratio(deviations.state) > smallest_pivot_ratio) {
      Eigen::MatrixXd of_interval =
          solve_square(Eigen::MatrixXd(deviations.state.transpose()), Eigen::MatrixXd(controls.transpose()))
              .transpose();
      if (program.node_state() == NodeState::velocity) {
        const MotionPoint node = trajectory.node(k);
        const auto values = legendre.at(node.q, node.v, trajectory.node_times[k]);
        of_interval = in_momenta(of_interval, values.mass, values.by_configuration);
      }
      for (Eigen::Index i = 0; i < s; ++i) {
        gains.of_stages[static_cast<std::size_t>(k * s + i)] = of_interval.middleRows(i * m, m);
      }
    }
    Eigen::MatrixXd both(2 * deviations.state.rows(), deviations.state.cols());
    both << deviations.state, deviations.costate;
    both = orthonormal_columns(both);
    deviations = {both.topRows(deviations.state.rows()), both.bottomRows(deviations.state.rows())};
  }
  return gains;
}

}  // namespace dmocbench
