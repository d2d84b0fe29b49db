#pragma once

#include <string>

namespace dmocbench {

/// A picture of gnuplot's as part of a page: without the lines of a file of its own, with names that begin with
/// `prefix`, and without what does not show: empty groups, marks that nobody uses, what a style sheet says for all
/// pictures, hundredths of a pixel. Empty if it is no SVG.
[[nodiscard]] std::string figure_markup(const std::string& file, const std::string& prefix, const std::string& title);

}  // namespace dmocbench
