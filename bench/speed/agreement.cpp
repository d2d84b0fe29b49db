#include "bench/speed/agreement.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/speed/tape_run.hpp"
#include "methods/error.hpp"

namespace dmocbench::speed {

void require_agreement(const Subject& subject, const Schedule& schedule, const std::string& name,
                       const ValuesOfInterval& values, double tolerance) {
  TapeRun reference(schedule, preferred_instruction_set(), Subject::intervals);
  reference.evaluate(subject.columns());
  for (std::size_t k = 0; k < Subject::intervals; ++k) {
    const std::vector<double> expected = reference.outputs().row(k);
    const std::vector<double> found = values(k);
    double largest = 0.0;
    double difference = 0.0;
    for (std::size_t e = 0; e < expected.size(); ++e) {
      largest = std::max(largest, std::abs(expected[e]));
      const double here = std::abs(expected[e] - found.at(e));
      if (!(here <= difference)) difference = here;  // true for NaN
    }
    if (difference <= tolerance * largest) continue;  // false for NaN
    throw Error(fmt::format("{} differs from the tape by {:.3g} on interval {} of {}", name, difference / largest, k,
                            subject.problem()));
  }
}

}  // namespace dmocbench::speed
