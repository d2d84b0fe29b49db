#include "bench/claims/words.hpp"

#include <algorithm>
#include <cmath>

namespace dmocbench {

bool Words::are_finite() const {
  return std::ranges::all_of(numbers, [](const Measurement& number) { return std::isfinite(number.value); });
}

Words joined(const std::vector<Words>& all, std::string_view separator) {
  Words result;
  for (const Words& words : all) {
    if (words.is_empty()) continue;
    if (!result.is_empty()) result.text += separator;
    result.text += words.text;
    result.numbers.insert(result.numbers.end(), words.numbers.begin(), words.numbers.end());
  }
  return result;
}

Words listed(std::string_view format, const std::vector<Measurement>& numbers) {
  return joined(numbers, ", ", [&](const Measurement& number) {
    return Words{.text = fmt::format(fmt::runtime(format), number), .numbers = {number}};
  });
}

}  // namespace dmocbench
