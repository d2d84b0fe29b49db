#include "bench/structure_advantage/operation_count.hpp"

#include "bench/structure_advantage/counting_kernel.hpp"
#include "methods/solvers/interior_point/banded_kkt.hpp"
#include "methods/solvers/interior_point/intervals/interval_kkt.hpp"
#include "methods/solvers/interior_point/sparse_kkt.hpp"

namespace dmocbench {

namespace {

/// The KKT system at a solution.
class System {
 public:
  System(NonlinearProgram& program, const Solution& solution)
      : hessian_(static_cast<Eigen::Index>(program.hessian_structure().size())),
        jacobian_(static_cast<Eigen::Index>(program.jacobian_structure().size())),
        diagonal_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.variable_count()))),
        compliance_((program.constraint_lower().array() != program.constraint_upper().array()).cast<double>()),
        slope_(Eigen::VectorXd::Ones(diagonal_.size())),
        rows_(Eigen::VectorXd::Ones(compliance_.size())) {
    program.hessian(solution.primal, 1.0, solution.multipliers, hessian_);
    program.jacobian(solution.primal, jacobian_);
  }

  /// With a unit shift where the Hessian needs one: counts of an elimination by intervals do not depend on numbers.
  [[nodiscard]] bool is_solved_by(interior_point::KktSystem& kkt) {
    Eigen::VectorXd primal_step(slope_.size());
    Eigen::VectorXd multiplier_step(rows_.size());
    for (const double shift : {0.0, 1.0}) {
      diagonal_.setConstant(shift);
      const auto verdict =
          kkt.solve({hessian_, jacobian_, diagonal_, compliance_}, {slope_, rows_}, {primal_step, multiplier_step});
      if (verdict == interior_point::FactorisationStatus::solved) return true;
    }
    return false;
  }

 private:
  Eigen::VectorXd hessian_;
  Eigen::VectorXd jacobian_;
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd compliance_;
  Eigen::VectorXd slope_;
  Eigen::VectorXd rows_;
};

double operations_of_last_sweep(const NonlinearProgram& program) {
  const SweepCount count = last_sweep_count();
  return (count.multiplications + count.divisions) * static_cast<double>(program.interval_structure()->intervals);
}

}  // namespace

OperationCount count_operations(NonlinearProgram& program, const Solution& solution, const std::string& factorisation) {
  OperationCount count;
  std::string why;
  System system(program, solution);
  if (factorisation == "intervals") {
    const auto kkt = interior_point::IntervalKkt::make(program, counting_segment_kernel);
    if (kkt && system.is_solved_by(**kkt)) count.elimination = operations_of_last_sweep(program);
  } else if (factorisation == "banded") {
    const auto kkt = interior_point::BandedKkt::make(program, why);
    if (!kkt || !system.is_solved_by(*kkt)) return count;
    count.elimination = kkt->factorisation_operations();
    count.half_bandwidth = static_cast<long long>(kkt->order().half_bandwidth);
  } else if (factorisation == "sparse") {
    interior_point::SparseKkt kkt(program);
    if (system.is_solved_by(kkt)) count.elimination = kkt.factorisation_operations();
  }
  return count;
}

}  // namespace dmocbench
