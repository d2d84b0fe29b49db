#include "bench/run/schemas.hpp"

#include "bench/run/embedded_file.hpp"

DMOCBENCH_EMBEDDED_FILE(metadata_schema, "bench/run/metadata.schema.json");
DMOCBENCH_EMBEDDED_FILE(problems_schema, "bench/run/problems.schema.json");

namespace dmocbench {

std::string_view metadata_schema() noexcept { return dmocbench_file_metadata_schema; }

std::string_view problem_cards_schema() noexcept { return dmocbench_file_problems_schema; }

}  // namespace dmocbench
