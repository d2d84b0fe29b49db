#pragma once

#include <string>
#include <vector>

#include "bench/report/results_folder.hpp"

namespace dmocbench {

/// The motions of one problem as a figure: where points of the picture go, drawn on top of each other where there are
/// several; JavaScript moves them through time. Where a picture has no point in the plane, its first quantities over
/// time, with a line at the time that is shown. Empty without a motion of at least two instants.
[[nodiscard]] std::string motion_picture_html(const std::string& problem,
                                              const std::vector<const ReportedMotion*>& motions);

}  // namespace dmocbench
