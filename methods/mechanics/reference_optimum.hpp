#pragma once

#include <string>
#include <vector>

namespace dmocbench {

/// A value of a problem's least cost that somebody published.
struct PublishedOptimum {
  double objective = 0.0;
  std::string source;
};

/// What is known of a problem's least cost: a closed form, or a number on which independent methods agree.
struct ReferenceOptimum {
  double objective = 0.0;
  /// Significant digits of `objective` that are certain; 16 for a closed form.
  int digits = 0;
  /// How it is known: "closed form", or which independent routes agree to that many digits.
  std::string certificate;
  std::vector<PublishedOptimum> published;
  /// Where the published values differ from `objective`, and why; empty if they do not.
  std::string remark;
};

}  // namespace dmocbench
