#pragma once

#include <optional>

namespace dmocbench::speed {

/// How much memory of this process was in use at most since the object was made, beyond what was then. Memory that
/// others freed before is handed back to the system first, where it can be, so that it does not hide what is taken
/// again; but pages that the heap cannot hand back do, which is some hundred kilobytes.
class PeakMemory {
 public:
  PeakMemory();
  /// In bytes; none where the system does not tell (it is Linux that does).
  [[nodiscard]] std::optional<double> growth() const;

 private:
  std::optional<double> before_;
};

}  // namespace dmocbench::speed
