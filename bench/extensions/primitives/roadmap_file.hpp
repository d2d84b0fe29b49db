#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "methods/extensions/primitives/stored_roadmap.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

// A roadmap as a file of JSON, version 1:
//   {"format": "dmocbench roadmap", "version": 1, "crc32": "0123abcd",
//    "content": {
//      "problem": NAME, "parameters": {NAME: VALUE, ...}, "step": DT, "intervals_per_step": M,
//      "states": [{"q": [...], "v": [...]}, ...],
//      "primitives": [{"first": STATE, "last": STATE, "displacement": {"linear": [[...], ...], "shift": [...]},
//                      "duration": STEPS, "cost": J, "q": [[...], ...], "v": [[...], ...], "u": [[...], ...]}, ...],
//      "nodes": [{"state": STATE, "linear": [[...], ...], "shift": [...]}, ...],
//      "edges": [[FROM, TO, PRIMITIVE], ...], "start": NODE, "goal": NODE}}
// Tables are row by row; numbers count from 0; "crc32" is the checksum of the content without blanks.

/// The text of such a file.
[[nodiscard]] std::string roadmap_text(const StoredRoadmap& stored);
/// The roadmap that a text stands for. Throws `Error` in one sentence if the text is cut off or damaged, or was made
/// for another problem or other parameters.
[[nodiscard]] StoredRoadmap roadmap_of(std::string_view text, const Problem& problem);

/// Writes the file whole or not at all. Throws `Error` if that cannot be done.
void write_roadmap(const std::filesystem::path& file, const StoredRoadmap& stored);
/// `roadmap_of` a file's text; sentences name the file.
[[nodiscard]] StoredRoadmap read_roadmap(const std::filesystem::path& file, const Problem& problem);

}  // namespace dmocbench
