#pragma once

#include <string>
#include <vector>

#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The names of a program's unknowns in AMPL's files, in the order of the program: `theta[3]` at node 3, `v_theta`
/// or `p_theta` there, `rate_1_theta[3]` of stage 1 in interval 3 (of the second half of the state `rate_1_v_theta`),
/// `tau[3]` of a control, `tau_2[3]` of stage 2 where there are several, `cost_so_far[3]` in Mayer form,
/// `v_theta_first`, `v_theta_last` and `T` where they are unknowns. Spaces in a problem's names become underscores.
[[nodiscard]] std::vector<std::string> ampl_variable_names(const Transcription& program);

/// The names of its rows: `node_theta[3]` of node 3, `equation_2[3]` of interval 3 (the element's own, counted from
/// 1), `path_2[3]` (bounded velocities, then path constraints, stage by stage), `cost_row[3]` in Mayer form,
/// `momentum_theta_first` and `_last` of an end, `condition_1` of the ends.
[[nodiscard]] std::vector<std::string> ampl_row_names(const Transcription& program);

}  // namespace dmocbench
