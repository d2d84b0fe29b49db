#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "problems/problem_registry.hpp"

namespace dmocbench {

/// Loads a shared library that `dmocbench_add_problems` made and adds its problems to `registry`, except those that
/// cannot be made or whose names are there already (`Registry::refused`); they come from its absolute path. It stays
/// loaded. Throws `Error` if the file cannot be read, is not such a library, was made by another build of dmocbench
/// (which is detected before any of its code runs), or if none of its problems is added.
///
/// Its formulas are traced by the functions of this program, which has to offer them: ENABLE_EXPORTS in CMake. The
/// symbols of a module that a program has loaded, as Python does, are made global for it.
void load_problem_library(const std::filesystem::path& file, Registry& registry);

/// The tag of this build, as in libraries of problems (build_tag.hpp).
[[nodiscard]] std::string_view tag_of_this_build() noexcept;

/// Throws `Error` that names the first difference if `tag`, from the file `who`, is not the tag of this build.
void require_same_build(const std::string& who, std::string_view tag);

}  // namespace dmocbench
