#pragma once

#include <nlohmann/json_fwd.hpp>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The card of a problem for programs of any kind: what it is, its data, ends, bounds, horizon, what else it
/// prescribes, and what is known of its optimum: the cost, how many digits of it are certain, by which routes,
/// published values. Numbers are in the units of the problem as solved; a side without a bound is null.
[[nodiscard]] nlohmann::ordered_json problem_card_json(const Problem& problem);

/// The JSON Schema (draft 2020-12) of an object whose array "problems" holds such cards.
[[nodiscard]] nlohmann::ordered_json problem_cards_schema();

}  // namespace dmocbench
