#include "bench/speed/agreement.hpp"

#include <algorithm>
#include <cmath>

#include "bench/speed/tape_run.hpp"
#include "methods/error.hpp"

namespace dmocbench::speed {

void require_agreement(const Subject& subject, const std::string& name, const HessianOfInterval& hessian) {
  constexpr double tolerance = 1e-10;
  TapeRun reference(subject.functions().hessian.schedule, preferred_instruction_set(), Subject::intervals);
  reference.evaluate(subject.columns());
  for (std::size_t k = 0; k < Subject::intervals; ++k) {
    const std::vector<double> entries = hessian(k);
    double largest = 0.0;
    double difference = 0.0;
    for (std::size_t e = 0; e < reference.tape().output_count(); ++e) {
      largest = std::max(largest, std::abs(reference.value(k, e)));
      difference = std::max(difference, std::abs(reference.value(k, e) - entries.at(e)));
    }
    if (difference <= tolerance * largest) continue;  // false for NaN
    throw Error(name + " differs from the tape by " + std::to_string(difference / largest) + " on interval " +
                std::to_string(k) + " of " + subject.problem());
  }
}

}  // namespace dmocbench::speed
