#pragma once

#include <string>

namespace dmocbench {

/// The same picture in fewer letters: colours as #0072b2, paths of straight lines by differences in tenths of a pixel,
/// marks of one colour in a row below one group that says it, no empty text. What has a name of its own stays as it is.
[[nodiscard]] std::string packed_svg(const std::string& picture);

}  // namespace dmocbench
