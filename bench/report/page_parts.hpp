#pragma once

#include <string_view>

namespace dmocbench {

/// plots/report/report.css and report.js, which the build puts into the program.
extern const std::string_view style_of_page;
extern const std::string_view script_of_page;
/// The 32 bytes of the script's SHA-256.
extern const std::string_view digest_of_script;

}  // namespace dmocbench
