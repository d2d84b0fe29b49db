#pragma once

#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The card of a problem as JSON, for other programs: its description, data, ends, bounds, horizon and constraints, and
/// the known facts about its optimum: the cost, the number of its certain digits, the routes to it, and published
/// values. Numbers are in the units of the problem as solved; a side without a bound is null. problems.schema.json is
/// the schema of an object whose array "problems" holds such cards.
[[nodiscard]] nlohmann::ordered_json problem_card_json(const Problem& problem);

/// The JSON Schema of the cards of problems, as `list --json` prints them.
[[nodiscard]] std::string_view problem_cards_schema() noexcept;

}  // namespace dmocbench
