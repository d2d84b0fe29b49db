#include "methods/solvers/ipopt_solver.hpp"

#if __has_include(<coin-or/IpIpoptApplication.hpp>)
#include <coin-or/IpIpoptApplication.hpp>
#include <coin-or/IpIpoptCalculatedQuantities.hpp>
#include <coin-or/IpIpoptData.hpp>
#include <coin-or/IpJournalist.hpp>
#include <coin-or/IpOrigIpoptNLP.hpp>
#include <coin-or/IpTNLP.hpp>
#include <coin-or/IpTNLPAdapter.hpp>
#else
#include <IpIpoptApplication.hpp>
#include <IpIpoptCalculatedQuantities.hpp>
#include <IpIpoptData.hpp>
#include <IpJournalist.hpp>
#include <IpOrigIpoptNLP.hpp>
#include <IpTNLP.hpp>
#include <IpTNLPAdapter.hpp>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "methods/error.hpp"
#include "methods/judgement/stop_rule.hpp"
#include "methods/kkt/symmetric_factorisation.hpp"
#include "methods/program/counted_program.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/iteration_scope.hpp"
#include "methods/solvers/run_alone.hpp"

namespace dmocbench {

namespace {

using Ipopt::Index;
using Ipopt::Number;

/// The largest and the mean magnitude of some vectors.
struct Magnitudes {
  double largest = 0.0;
  double mean = 0.0;

  Magnitudes(std::initializer_list<Ipopt::SmartPtr<const Ipopt::Vector>> vectors) {
    Index count = 0;
    for (const auto& vector : vectors) {
      count += vector->Dim();
      largest = std::max(largest, vector->Amax());
      mean += vector->Asum();
    }
    mean /= std::max(count, 1);
  }
};

/// Ipopt's residuals in the order of the program's rows and variables; none if it works on another program.
struct OrderedResiduals {
  Eigen::VectorXd violations;
  Eigen::VectorXd gradient;  // of the Lagrangian; 0 of fixed variables
};

std::optional<OrderedResiduals> ordered(const NonlinearProgram& program, Ipopt::IpoptCalculatedQuantities& quantities) {
  auto* const inner = dynamic_cast<Ipopt::OrigIpoptNLP*>(Ipopt::GetRawPtr(quantities.GetIpoptNLP()));
  if (inner == nullptr) return std::nullopt;
  auto* const adapter = dynamic_cast<Ipopt::TNLPAdapter*>(Ipopt::GetRawPtr(inner->nlp()));
  if (adapter == nullptr) return std::nullopt;
  OrderedResiduals residuals{.violations = Eigen::VectorXd::Zero(static_cast<Index>(program.constraint_count())),
                             .gradient = Eigen::VectorXd::Zero(static_cast<Index>(program.variable_count()))};
  adapter->ResortG(*quantities.curr_c(), *quantities.curr_d_minus_s(), residuals.violations.data());
  adapter->ResortX(*quantities.curr_grad_lag_x(), residuals.gradient.data());
  for (Eigen::Index j = 0; j < residuals.gradient.size(); ++j) {
    if (is_fixed(program, j)) residuals.gradient[j] = 0.0;
  }
  return residuals;
}

/// Whether an iterate of Ipopt meets our stopping rule. Ipopt's own test ignores rounding, so that on long grids it
/// would continue where other solvers stop.
bool meets(const StopRule& allowed, const NonlinearProgram& program, const Ipopt::IteratesVector& at,
           Ipopt::IpoptCalculatedQuantities& quantities) {
  const Magnitudes of_constraints({at.y_c(), at.y_d()});
  const Magnitudes of_bounds({at.z_L(), at.z_U(), at.v_L(), at.v_U()});
  const Magnitudes all({at.y_c(), at.y_d(), at.z_L(), at.z_U(), at.v_L(), at.v_U()});
  if (quantities.curr_complementarity(0.0, Ipopt::NORM_MAX) > allowed.complementarity(of_bounds.mean)) return false;
  const double stationarity = allowed.stationarity(all.mean, of_constraints.largest);
  if (quantities.curr_primal_infeasibility(Ipopt::NORM_MAX) <= allowed.violation() &&
      quantities.curr_dual_infeasibility(Ipopt::NORM_MAX) <= stationarity) {
    return true;
  }
  if (allowed.is_one_for_all() || quantities.curr_grad_lag_s()->Amax() > stationarity) return false;
  const auto residuals = ordered(program, quantities);
  return residuals && allowed.share_of_violation(residuals->violations) <= 1.0 &&
         allowed.share_of_stationarity(residuals->gradient, all.mean, of_constraints.largest) <= 1.0;
}

/// Ipopt's view of a program; it collects the answer.
class ProgramForIpopt final : public Ipopt::TNLP {
 public:
  ProgramForIpopt(CountedProgram& program, const Eigen::VectorXd& start, const SolverOptions& options,
                  bool has_rule_of_its_own, Solution& solution)
      : program_(program),
        start_(start),
        options_(options),
        solution_(solution),
        tolerances_(program, options.tolerance),
        has_rule_of_its_own_(has_rule_of_its_own) {}

  /// Whether Ipopt was stopped because its point meets our rule.
  [[nodiscard]] bool has_converged() const { return has_converged_; }
  /// Whether it was stopped because the time was up.
  [[nodiscard]] bool is_late() const { return is_late_; }
  /// The last point whose gradient was evaluated: an iterate. Empty before the first.
  [[nodiscard]] const Eigen::VectorXd& last_point() const { return last_point_; }

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
    if (must_end()) return false;
    value = program_.objective(point(x, n));
    return std::isfinite(value);
  }

  bool eval_grad_f(Index n, const Number* x, bool /*new_x*/, Number* values) override {
    last_point_ = point(x, n);
    program_.gradient(last_point_, array(values, n));
    return true;
  }

  bool eval_g(Index n, const Number* x, bool /*new_x*/, Index m, Number* values) override {
    if (must_end()) {
      std::fill_n(values, m, std::numeric_limits<double>::quiet_NaN());  // Ipopt reads them even where we return false
      return true;
    }
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

  bool intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number objective, Number violation,
                             Number stationarity, Number, Number, Number, Number, Number, Index,
                             const Ipopt::IpoptData* data, Ipopt::IpoptCalculatedQuantities* quantities) override {
    solution_.major_iterations = static_cast<int>(iteration);
    has_converged_ = !has_rule_of_its_own_ && mode == Ipopt::RegularMode && data != nullptr && quantities != nullptr &&
                     meets(tolerances_, program_, *data->curr(), *quantities);
    if (iteration > 0) {
      report_iteration({.solver = "ipopt",
                        .number = static_cast<int>(iteration),
                        .objective = objective,
                        .violation = violation,
                        .stationarity = stationarity});
    }
    if (has_converged_ || must_end()) return false;
    return !(options_.stop_requested && options_.stop_requested());
  }

  void finalize_solution(Ipopt::SolverReturn /*status*/, Index n, const Number* x, const Number*, const Number*,
                         Index m, const Number*, const Number* lambda, Number /*objective*/,
                         const Ipopt::IpoptData* /*data*/, Ipopt::IpoptCalculatedQuantities* /*quantities*/) override {
    if (x != nullptr) solution_.primal = Eigen::Map<const Eigen::VectorXd>(x, n);
    if (lambda != nullptr) solution_.multipliers = Eigen::Map<const Eigen::VectorXd>(lambda, m);
  }

 private:
  /// Ipopt checks CPU time, and between iterations only. Values that are not numbers end a long line search too.
  [[nodiscard]] bool must_end() {
    is_late_ = is_late_ || program_.is_out_of_time();
    return is_late_;
  }

  static Eigen::Map<const Eigen::VectorXd> point(const Number* values, Index size) { return {values, size}; }
  static Eigen::Map<Eigen::VectorXd> array(Number* values, Index size) { return {values, size}; }

  static bool copy(const BlockPattern& pattern, Index* rows, Index* columns) {
    pattern.for_each([&](Eigen::Index e, int row, int column) {
      rows[e] = row;
      columns[e] = column;
    });
    return true;
  }

  CountedProgram& program_;
  const Eigen::VectorXd& start_;
  const SolverOptions& options_;
  Solution& solution_;
  StopRule tolerances_;
  bool has_rule_of_its_own_;
  bool has_converged_ = false;
  bool is_late_ = false;
  Eigen::VectorXd last_point_;
};

/// Listens to Ipopt's reports on its linear systems: where these fail for want of memory, Ipopt's status reports only
/// that a step could not be computed.
class MemoryReports final : public Ipopt::Journal {
 public:
  MemoryReports() : Journal("memory", Ipopt::J_NONE) { SetPrintLevel(Ipopt::J_LINEAR_ALGEBRA, Ipopt::J_WARNING); }

  [[nodiscard]] bool tell_of_failure() const { return tell_of_failure_; }

 private:
  void PrintImpl(Ipopt::EJournalCategory /*category*/, Ipopt::EJournalLevel /*level*/, const char* text) override {
    const std::string_view report(text);
    for (const std::string_view words : {"out of memory", "not able to obtain enough memory", "INFO(1) = -7"}) {
      tell_of_failure_ = tell_of_failure_ || report.find(words) != std::string_view::npos;
    }
  }
  void PrintfImpl(Ipopt::EJournalCategory category, Ipopt::EJournalLevel level, const char* format,
                  va_list arguments) override {
    std::array<char, 512> text{};
    static_cast<void>(std::vsnprintf(text.data(), text.size(), format, arguments));
    PrintImpl(category, level, text.data());
  }
  void FlushBufferImpl() override {}

  bool tell_of_failure_ = false;
};

Status status_of(Ipopt::ApplicationReturnStatus status) {
  static const std::map<Ipopt::ApplicationReturnStatus, Status> meanings{
      {Ipopt::Solve_Succeeded, Status::solved},
      {Ipopt::Feasible_Point_Found, Status::solved},
      {Ipopt::Solved_To_Acceptable_Level, Status::acceptable},
      {Ipopt::Infeasible_Problem_Detected, Status::infeasible},
      {Ipopt::Search_Direction_Becomes_Too_Small, Status::step_failed},
      {Ipopt::Restoration_Failed, Status::step_failed},
      {Ipopt::Error_In_Step_Computation, Status::step_failed},
      {Ipopt::Diverging_Iterates, Status::diverged},
      {Ipopt::User_Requested_Stop, Status::interrupted},
      {Ipopt::Maximum_Iterations_Exceeded, Status::iteration_limit},
      {Ipopt::Maximum_CpuTime_Exceeded, Status::time_limit},
      {Ipopt::Not_Enough_Degrees_Of_Freedom, Status::invalid_program},
      {Ipopt::Invalid_Problem_Definition, Status::invalid_program},
      {Ipopt::Invalid_Option, Status::invalid_program},
      {Ipopt::Invalid_Number_Detected, Status::evaluation_failed},
      {Ipopt::Insufficient_Memory, Status::out_of_memory},
  };
  const auto found = meanings.find(status);
  return found != meanings.end() ? found->second : Status::solver_error;  // exceptions and internal errors
}

/// Sets an option whose type is defined by Ipopt: as an integer, a number or a string, whichever it takes.
void pass_on(Ipopt::OptionsList& list, const std::string& name, const std::string& value) {
  const auto whole = parsed<int>(value);
  if (whole && list.SetIntegerValue(name, *whole)) return;
  const auto number = parsed<double>(value);
  if (number && list.SetNumericValue(name, *number)) return;
  if (list.SetStringValue(name, value)) return;
  throw Error("Ipopt rejects the option {}={}; the Ipopt manual lists the options", name, value);
}

void set_options(Ipopt::IpoptApplication& application, const SolverOptions& options, const NamedOptions& named) {
  Ipopt::OptionsList& list = *application.Options();
  list.SetStringValue("sb", "yes");
  list.SetIntegerValue("print_level", options.verbose ? 5 : 0);
  list.SetNumericValue("tol", options.tolerance);
  // Ipopt stops by its unscaled defaults (dual 1, violation 1e-4) too; ours are the tolerance itself.
  list.SetNumericValue("constr_viol_tol", options.tolerance);
  list.SetIntegerValue("max_iter", options.most_iterations);
  list.SetStringValue("nlp_scaling_method", "none");
  list.SetNumericValue("bound_relax_factor", 0.0);
  list.SetStringValue("check_derivatives_for_naninf", "yes");  // else a NaN ends as a failed step
  for (const auto& [name, value] : named) pass_on(list, name, value);
}

/// Ipopt with all options set. Throws `Error` if it does not take one.
Ipopt::SmartPtr<Ipopt::IpoptApplication> application_with(const SolverOptions& options, const NamedOptions& named) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(options.verbose);
  application->RethrowNonIpoptException(true);
  set_options(*application, options, named);
  if (application->Initialize("") != Ipopt::Solve_Succeeded) {
    throw Error("Ipopt rejects one of the options passed to it");
  }
  return application;
}

}  // namespace

IpoptSolver::IpoptSolver(SolverOptions options, NamedOptions named)
    : SolverWithoutMemory(
          "ipopt", "interior-point method with filter line search (Ipopt " IPOPT_VERSION "), exact sparse derivatives",
          std::move(options)),
      named_(std::move(named)) {
  if (named_.empty()) return;
  const auto lock = lock_mumps();
  static_cast<void>(application_with(this->options(), named_));
}

Solution IpoptSolver::run(CountedProgram& program, const Eigen::VectorXd& start) const {
  return run_alone(program, start, options(), [&] { return run_ipopt(program, start); });
}

Solution IpoptSolver::run_ipopt(CountedProgram& program, const Eigen::VectorXd& start) const {
  Solution solution;
  const Clock::time_point begin = Clock::now();
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = application_with(options(), named_);
  const Ipopt::SmartPtr<MemoryReports> memory = new MemoryReports;
  application->Jnlst()->AddJournal(Ipopt::GetRawPtr(memory));
  program.leave_out(seconds_since(begin));
  const Ipopt::SmartPtr<ProgramForIpopt> for_ipopt =
      new ProgramForIpopt(program, start, options(), named_.contains("tol"), solution);
  try {
    const Ipopt::ApplicationReturnStatus status = application->OptimizeTNLP(Ipopt::GetRawPtr(for_ipopt));
    solution.status = for_ipopt->has_converged() ? Status::solved
                      : for_ipopt->is_late()     ? Status::time_limit
                                                 : status_of(status);
  } catch (const Stopped&) {  // within a factorisation
    solution.status = program.is_out_of_time() ? Status::time_limit : Status::interrupted;
    solution.primal = for_ipopt->last_point();
    if (solution.primal.size() == 0) solution.primal = start;
  }
  const bool has_failed = solution.status == Status::step_failed || solution.status == Status::solver_error;
  if (has_failed && memory->tell_of_failure()) solution.status = Status::out_of_memory;
  if (solution.status == Status::time_limit && solution.primal.size() == 0) solution.primal = start;
  return solution;
}

}  // namespace dmocbench
