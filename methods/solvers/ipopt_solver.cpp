#include "methods/solvers/ipopt_solver.hpp"

#if __has_include(<coin-or/IpIpoptApplication.hpp>)
#include <coin-or/IpIpoptApplication.hpp>
#include <coin-or/IpIpoptCalculatedQuantities.hpp>
#include <coin-or/IpIpoptData.hpp>
#include <coin-or/IpTNLP.hpp>
#else
#include <IpIpoptApplication.hpp>
#include <IpIpoptCalculatedQuantities.hpp>
#include <IpIpoptData.hpp>
#include <IpTNLP.hpp>
#endif

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>

#include "methods/error.hpp"
#include "methods/solvers/counted_program.hpp"
#include "methods/solvers/stop_rule.hpp"

namespace dmocbench {

namespace {

using Ipopt::Index;
using Ipopt::Number;

/// The largest and the mean magnitude of some vectors.
class Magnitudes {
 public:
  explicit Magnitudes(std::initializer_list<Ipopt::SmartPtr<const Ipopt::Vector>> vectors) {
    Index count = 0;
    for (const auto& vector : vectors) {
      count += vector->Dim();
      largest = std::max(largest, vector->Amax());
      mean += vector->Asum();
    }
    mean /= std::max(count, 1);
  }

  double largest = 0.0;
  double mean = 0.0;
};

/// Whether an iterate of Ipopt fulfils our rule. Ipopt's own test knows nothing of rounding: on long grids it would go
/// on where other solvers stop.
bool fulfils(const StopRule& tolerances, const Ipopt::IteratesVector& at,
             Ipopt::IpoptCalculatedQuantities& quantities) {
  if (quantities.curr_primal_infeasibility(Ipopt::NORM_MAX) > tolerances.violation()) return false;
  const Magnitudes of_rows({at.y_c(), at.y_d()});
  const Magnitudes of_bounds({at.z_L(), at.z_U(), at.v_L(), at.v_U()});
  const Magnitudes all({at.y_c(), at.y_d(), at.z_L(), at.z_U(), at.v_L(), at.v_U()});
  return quantities.curr_dual_infeasibility(Ipopt::NORM_MAX) <= tolerances.stationarity(all.mean, of_rows.largest) &&
         quantities.curr_complementarity(0.0, Ipopt::NORM_MAX) <= tolerances.complementarity(of_bounds.mean);
}

/// Ipopt's view of a program; it collects the answer.
class ProgramForIpopt final : public Ipopt::TNLP {
 public:
  ProgramForIpopt(NonlinearProgram& program, const Eigen::VectorXd& start, const SolverOptions& options,
                  Solution& solution)
      : program_(program),
        start_(start),
        options_(options),
        solution_(solution),
        tolerances_(program, options.tolerance),
        has_rule_of_its_own_(options.passed_on.contains("tol")) {}

  /// Whether Ipopt was told to stop because its point fulfils our rule.
  [[nodiscard]] bool has_converged() const { return has_converged_; }

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac_g, Index& nnz_h_lag, IndexStyleEnum& index_style) override {
    n = static_cast<Index>(program_.variable_count());
    m = static_cast<Index>(program_.constraint_count());
    nnz_jac_g = static_cast<Index>(program_.jacobian_structure().size());
    nnz_h_lag = static_cast<Index>(program_.hessian_structure().size());
    index_style = TNLP::C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* x_l, Number* x_u, Index m, Number* g_l, Number* g_u) override {
    std::copy_n(program_.variable_lower().data(), n, x_l);
    std::copy_n(program_.variable_upper().data(), n, x_u);
    std::copy_n(program_.constraint_lower().data(), m, g_l);
    std::copy_n(program_.constraint_upper().data(), m, g_u);
    return true;
  }

  bool get_starting_point(Index n, bool init_x, Number* x, bool init_z, Number* /*z_L*/, Number* /*z_U*/, Index /*m*/,
                          bool init_lambda, Number* /*lambda*/) override {
    if (init_z || init_lambda) return false;
    if (init_x) std::copy_n(start_.data(), n, x);
    return true;
  }

  bool eval_f(Index n, const Number* x, bool /*new_x*/, Number& value) override {
    value = program_.objective(point(x, n));
    return std::isfinite(value);
  }

  bool eval_grad_f(Index n, const Number* x, bool /*new_x*/, Number* values) override {
    program_.gradient(point(x, n), array(values, n));
    return true;
  }

  bool eval_g(Index n, const Number* x, bool /*new_x*/, Index m, Number* values) override {
    program_.constraints(point(x, n), array(values, m));
    return true;
  }

  bool eval_jac_g(Index n, const Number* x, bool /*new_x*/, Index /*m*/, Index nonzeros, Index* rows, Index* columns,
                  Number* values) override {
    if (values == nullptr) return copy(program_.jacobian_structure(), rows, columns);
    program_.jacobian(point(x, n), array(values, nonzeros));
    return true;
  }

  bool eval_h(Index n, const Number* x, bool /*new_x*/, Number objective_factor, Index m, const Number* lambda,
              bool /*new_lambda*/, Index nonzeros, Index* rows, Index* columns, Number* values) override {
    if (values == nullptr) return copy(program_.hessian_structure(), rows, columns);
    program_.hessian(point(x, n), objective_factor, point(lambda, m), array(values, nonzeros));
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number, Number, Number, Number, Number, Number,
                             Number, Number, Index, const Ipopt::IpoptData* data,
                             Ipopt::IpoptCalculatedQuantities* quantities) override {
    solution_.major_iterations = static_cast<int>(iteration);
    has_converged_ = !has_rule_of_its_own_ && mode == Ipopt::RegularMode && data != nullptr && quantities != nullptr &&
                     fulfils(tolerances_, *data->curr(), *quantities);
    if (has_converged_) return false;
    return !(options_.stop_requested && options_.stop_requested());
  }

  void finalize_solution(Ipopt::SolverReturn /*status*/, Index n, const Number* x, const Number*, const Number*,
                         Index m, const Number*, const Number* lambda, Number /*objective*/,
                         const Ipopt::IpoptData* /*data*/, Ipopt::IpoptCalculatedQuantities* /*quantities*/) override {
    if (x != nullptr) solution_.primal = Eigen::Map<const Eigen::VectorXd>(x, n);
    if (lambda != nullptr) solution_.multipliers = Eigen::Map<const Eigen::VectorXd>(lambda, m);
  }

 private:
  static Eigen::Map<const Eigen::VectorXd> point(const Number* values, Index size) { return {values, size}; }
  static Eigen::Map<Eigen::VectorXd> array(Number* values, Index size) { return {values, size}; }

  static bool copy(const BlockPattern& pattern, Index* rows, Index* columns) {
    pattern.for_each([&](Eigen::Index e, int row, int column) {
      rows[e] = row;
      columns[e] = column;
    });
    return true;
  }

  NonlinearProgram& program_;
  const Eigen::VectorXd& start_;
  const SolverOptions& options_;
  Solution& solution_;
  StopRule tolerances_;
  bool has_rule_of_its_own_;
  bool has_converged_ = false;
};

Status status_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
    case Ipopt::Feasible_Point_Found:
      return Status::solved;
    case Ipopt::Solved_To_Acceptable_Level:
      return Status::acceptable;
    case Ipopt::Infeasible_Problem_Detected:
      return Status::infeasible;
    case Ipopt::Search_Direction_Becomes_Too_Small:
    case Ipopt::Restoration_Failed:
    case Ipopt::Error_In_Step_Computation:
      return Status::step_failed;
    case Ipopt::Diverging_Iterates:
      return Status::diverged;
    case Ipopt::User_Requested_Stop:
      return Status::interrupted;
    case Ipopt::Maximum_Iterations_Exceeded:
      return Status::iteration_limit;
    case Ipopt::Maximum_CpuTime_Exceeded:
      return Status::time_limit;
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
    case Ipopt::Invalid_Problem_Definition:
    case Ipopt::Invalid_Option:
      return Status::invalid_program;
    case Ipopt::Invalid_Number_Detected:
      return Status::evaluation_failed;
    case Ipopt::Insufficient_Memory:
      return Status::out_of_memory;
    default:
      return Status::solver_error;  // exceptions and internal errors; later versions add codes
  }
}

/// Sets an option whose type only Ipopt knows: as an integer, a number or a string, whichever it takes.
void pass_on(Ipopt::OptionsList& list, const std::string& name, const std::string& value) {
  const char* end = value.data() + value.size();
  int whole = 0;
  const auto as_whole = std::from_chars(value.data(), end, whole);
  if (as_whole.ec == std::errc() && as_whole.ptr == end && list.SetIntegerValue(name, whole)) return;
  double number = 0.0;
  const auto as_number = std::from_chars(value.data(), end, number);
  if (as_number.ec == std::errc() && as_number.ptr == end && list.SetNumericValue(name, number)) return;
  if (list.SetStringValue(name, value)) return;
  throw Error("Ipopt does not take the option " + name + "=" + value);
}

void set_options(Ipopt::IpoptApplication& application, const SolverOptions& options) {
  Ipopt::OptionsList& list = *application.Options();
  list.SetStringValue("sb", "yes");
  list.SetIntegerValue("print_level", options.verbose ? 5 : 0);
  list.SetNumericValue("tol", options.tolerance);
  // Ipopt stops by its unscaled defaults (dual 1, violation 1e-4) too; ours are the tolerance itself.
  list.SetNumericValue("constr_viol_tol", options.tolerance);
  list.SetIntegerValue("max_iter", options.most_iterations);
  if (options.most_seconds > 0.0) list.SetNumericValue("max_cpu_time", options.most_seconds);
  list.SetStringValue("nlp_scaling_method", "none");
  list.SetNumericValue("bound_relax_factor", 0.0);
  list.SetStringValue("check_derivatives_for_naninf", "yes");  // else a NaN ends as a failed step
  for (const auto& [name, value] : options.passed_on) pass_on(list, name, value);
}

}  // namespace

std::string IpoptSolver::description() const {
  return "interior-point method with filter line search (Ipopt " IPOPT_VERSION "), exact sparse derivatives";
}

Solution IpoptSolver::run(CountedProgram& program, const Eigen::VectorXd& start) const {
  Solution solution;
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(options().verbose);
  application->RethrowNonIpoptException(true);
  set_options(*application, options());
  if (application->Initialize("") != Ipopt::Solve_Succeeded) {
    throw Error("Ipopt refuses one of the options passed on to it");
  }
  const Ipopt::SmartPtr<ProgramForIpopt> for_ipopt = new ProgramForIpopt(program, start, options(), solution);
  const Ipopt::ApplicationReturnStatus status = application->OptimizeTNLP(Ipopt::GetRawPtr(for_ipopt));
  solution.status = for_ipopt->has_converged() ? Status::solved : status_of(status);
  return solution;
}

}  // namespace dmocbench
