#include "bench/experiments/operation_count.hpp"

#include <algorithm>
#include <array>

#include "bench/experiments/banded_kkt.hpp"
#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/kkt/sparse_kkt.hpp"

namespace dmocbench {

namespace {

/// Solves the KKT system at a solution, with a unit shift where the Hessian needs one: counts of an elimination by
/// intervals do not depend on numbers.
bool is_solved(NonlinearProgram& program, const Solution& solution, kkt::KktSystem& kkt) {
  Eigen::VectorXd hessian(static_cast<Eigen::Index>(program.hessian_structure().size()));
  Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  program.hessian(solution.primal, 1.0, solution.multipliers, hessian);
  program.jacobian(solution.primal, jacobian);
  const Eigen::VectorXd compliance =
      (program.constraint_lower().array() != program.constraint_upper().array()).cast<double>();
  const auto variables = static_cast<Eigen::Index>(program.variable_count());
  const Eigen::VectorXd gradient = Eigen::VectorXd::Ones(variables);
  const Eigen::VectorXd constraints = Eigen::VectorXd::Ones(compliance.size());
  Eigen::VectorXd primal_step(variables);
  Eigen::VectorXd multiplier_step(compliance.size());
  return std::ranges::any_of(std::array{0.0, 1.0}, [&](double shift) {
    const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(variables, shift);
    return kkt.solve({hessian, jacobian, diagonal, compliance}, {gradient, constraints},
                     {primal_step, multiplier_step}) == kkt::FactorisationStatus::solved;
  });
}

}  // namespace

OperationCount count_operations(NonlinearProgram& program, const Solution& solution, const std::string& factorisation) {
  OperationCount count;
  if (factorisation == "intervals") {
    const auto kkt = kkt::IntervalKkt::make(program, counting_segment_kernel);
    if (!kkt || !is_solved(program, solution, **kkt)) return count;
    count.elimination =
        counted_operations_per_interval() * static_cast<double>(program.interval_structure()->intervals);
  } else if (factorisation == "banded") {
    kkt::BandedKkt kkt(program);
    if (!is_solved(program, solution, kkt)) return count;
    count.elimination = kkt.factorisation_operations();
    count.half_bandwidth = static_cast<long long>(kkt.order().half_bandwidth);
  } else if (factorisation == "sparse") {
    kkt::SparseKkt kkt(program);
    if (is_solved(program, solution, kkt)) count.elimination = kkt.factorisation_operations();
  }
  return count;
}

}  // namespace dmocbench
