#pragma once

#include <string_view>

namespace dmocbench {

/// The JSON Schema of a run's metadata, NAME.json: the properties that every run has, including its tables' entries.
[[nodiscard]] std::string_view metadata_schema() noexcept;

/// The JSON Schema of the cards of problems (`problem_card_json`), as `list --json` prints them.
[[nodiscard]] std::string_view problem_cards_schema() noexcept;

}  // namespace dmocbench
