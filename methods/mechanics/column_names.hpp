#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// True if a text has a control character (of one byte, or of two in UTF-8): a line break, or a terminal's command.
[[nodiscard]] bool has_control_character(std::string_view text) noexcept;

/// A column's name with its unit, which MATLAB and R keep: "t_in_s", "thrust_in_m_per_s2", "tau_in_N_m"; the
/// name alone where there is no unit.
[[nodiscard]] std::string name_with_unit(const std::string& name, const std::string& unit);
/// The name and the unit, as such a column spells it; the unit is empty where it has none.
[[nodiscard]] std::pair<std::string, std::string> name_and_unit(const std::string& column);

/// Throws `Error` unless every column of a problem's motion files has its own name that a table can have: the names
/// of q and u, and v_NAME, p_NAME, psi_q_NAME and psi_p_NAME of every q.
void require_names(const Problem& problem);

/// The same of the columns that the problem's picture has.
void require_names(const Problem& problem, const Picture& picture);

}  // namespace dmocbench
