#pragma once

#include <string>

#include "bench/report/results_folder.hpp"

namespace dmocbench {

/// A results folder as one self-contained page of HTML: the templates, style and script of plots/report, which are part
/// of the program, filled with the models of model.hpp. The page reads no files and no network. Claims, pictures of
/// motions and statements of problems are readable without JavaScript; figures and rows of tables are packed in the
/// page and unpacked when they are opened. `folder` is the path from the page's folder to the results, for downloads;
/// empty where they are the same.
[[nodiscard]] std::string report_page(const ResultsFolder& results, const std::string& folder);

}  // namespace dmocbench
