#pragma once

#include "bench/experiment/table.hpp"

namespace dmocbench {

/// The forced discrete Noether theorem (th:discforcNoe, eq:noether_force_d): `steps` steps of the one-step map under
/// arbitrary stage controls. Columns: problem, method, tableau, stages, force ("orthogonal" to the group action or
/// "along" it), steps, h, momentum_change (J_N - J_0), work (Σ h Σ b_i f·ξ), work_of_discrete_forces (Σ (f_d^-·ξ(q_k) +
/// f_d^+·ξ(q_{k+1})), DMOC only), defect (max over k of |J_k - J_0 - work|), defect_in_long_double (the same with 64
/// bits of mantissa: what is rounding shrinks two thousandfold, what is discretisation stays).
[[nodiscard]] Table noether_table(int steps);

/// The unforced one-step map's |DᵀΩD - Ω|, the largest over some states. Columns: problem, method, tableau, stages, h,
/// defect, rounding (machine epsilon times the largest square of an entry of D).
[[nodiscard]] Table symplecticity_table();

}  // namespace dmocbench
