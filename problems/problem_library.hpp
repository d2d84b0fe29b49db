#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "problems/problem_registry.hpp"

namespace dmocbench {

/// Loads a shared library that `dmocbench_add_problems` made and adds its problems to `registry`, all or none; they
/// come from its absolute path. It stays loaded. Throws `Error` if the file cannot be read, is no such library, was
/// made by another build of dmocbench (which is found out before anything of it runs), has no problem, or one whose
/// name `registry` has.
///
/// Its formulas are traced by the functions of this program, which has to offer them: ENABLE_EXPORTS in CMake.
void load_problem_library(const std::filesystem::path& file, Registry& registry);

/// What this build is, as libraries of problems bear it (build_tag.hpp).
[[nodiscard]] std::string_view tag_of_this_build() noexcept;

/// Throws `Error` that names the first difference if `tag`, from the file `who`, is not that of this build.
void require_same_build(const std::string& who, std::string_view tag);

}  // namespace dmocbench
