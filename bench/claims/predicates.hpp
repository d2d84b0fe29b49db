#pragma once

#include <string>
#include <vector>

#include "bench/claims/claim.hpp"

namespace dmocbench {

/// Every claim of the paper with its verdict, computed from the tables by the predicates below. Rows that are not
/// solved or on another branch make a claim about all grids "differs", never better.
[[nodiscard]] std::vector<Claim> judge_claims(const ResultTables& tables);

// One predicate each; "not yet" where the table is not there. The numbers that decide stand at the head of its file.

/// The fitted slope of a quantity ("state", "control") in a table of slopes.
[[nodiscard]] Claim slope_claim(const ResultTables& tables, const std::string& problem, const std::string& quantity,
                                const std::string& table);
/// The step that the paper prints for its reference grid.
[[nodiscard]] Claim step_claim(const ResultTables& tables, const std::string& problem);
/// Momentum-force consistency.
[[nodiscard]] Claim consistency_claim(const ResultTables& tables, const std::string& problem);
/// Equal solutions of DMOC and Hamiltonian collocation.
[[nodiscard]] Claim equality_claim(const ResultTables& tables, const std::string& problem);
/// Different solutions of tangent-space collocation, and the order of the difference.
[[nodiscard]] Claim difference_claim(const ResultTables& tables, const std::string& problem);
/// Equal solutions of tangent-space collocation by Gauss where the mass is constant.
[[nodiscard]] Claim coincidence_claim(const ResultTables& tables);
/// Order of state, momentum, costate and u(x, ψ) at the nodes.
[[nodiscard]] Claim convergence_order_claim(const ResultTables& tables, const std::string& problem);
/// The adjoint scheme: its residual on solved multipliers, and the order of the costates.
[[nodiscard]] Claim adjoint_order_claim(const ResultTables& tables, const std::string& problem);
/// The lower order of the stage controls.
[[nodiscard]] Claim stage_control_claim(const ResultTables& tables, const std::string& problem);
/// The ratio of the numbers of variables.
[[nodiscard]] Claim variable_claim(const ResultTables& tables, const std::string& problem);
/// The optimal cost over the grids.
[[nodiscard]] Claim objective_claim(const ResultTables& tables, const std::string& problem);
/// The ratio of the numbers of minor iterations.
[[nodiscard]] Claim minor_iterations_claim(const ResultTables& tables, const std::string& problem);
/// That this ratio is the one of the numbers of variables.
[[nodiscard]] Claim agreement_claim(const ResultTables& tables, const std::string& problem);
/// The same ratio where the first basis is chosen for free.
[[nodiscard]] Claim crash_claim(const ResultTables& tables, const std::string& problem);
/// That collocation takes longer by every solver.
[[nodiscard]] Claim expense_claim(const ResultTables& tables, const std::string& problem);
/// That this is by its size: a factorisation takes more operations whatever solver is used.
[[nodiscard]] Claim factorisation_claim(const ResultTables& tables, const std::string& problem);
/// Derivatives by automatic differentiation against finite differences.
[[nodiscard]] Claim derivatives_claim(const ResultTables& tables, const std::string& problem);
/// The paper's own tool against central differences, by time.
[[nodiscard]] Claim adolc_claim(const ResultTables& tables, const std::string& problem);
/// A statement of order h^(r + 1) about quantities of the table of consistency orders.
struct ConsistencyClaim {
  std::string id;
  std::string where;
  std::string paper;
  std::vector<std::string> quantities;
};
[[nodiscard]] Claim consistency_order_claim(const ResultTables& tables, const std::string& problem,
                                            const ConsistencyClaim& what);
/// The forced discrete Noether theorem, with a force "along" the group action or "orthogonal" to it.
[[nodiscard]] Claim noether_claim(const ResultTables& tables, const char* force);
/// Symplecticity of the unforced one-step map.
[[nodiscard]] Claim symplecticity_claim(const ResultTables& tables);
/// Energy over many periods.
[[nodiscard]] Claim modified_energy_claim(const ResultTables& tables);
/// Local minima from many starts.
[[nodiscard]] Claim local_minima_claim(const ResultTables& tables, const std::string& problem);
/// That one method finds the best of them more often.
[[nodiscard]] Claim best_minimum_claim(const ResultTables& tables, const std::string& problem);
/// Who is best over the library by a measure of `profile_measures`.
[[nodiscard]] Claim library_claim(const ResultTables& tables, const std::string& measure);
/// A row of the table of slips.
[[nodiscard]] Claim slip_claim(const Row& row);

}  // namespace dmocbench
