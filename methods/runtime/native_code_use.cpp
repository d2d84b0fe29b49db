#include "methods/runtime/native_code_use.hpp"

#include <array>
#include <cstdlib>

#include "methods/choose.hpp"

namespace dmocbench {

std::string_view name_of_use(NativeCodeUse use) noexcept {
  constexpr std::array<std::string_view, 3> names{"when_worthwhile", "never", "always"};
  return names.at(static_cast<std::size_t>(use));
}

NativeCodeUse preferred_native_code_use() {
  const char* wanted = std::getenv("DMOCBENCH_NATIVE_CODE");  // NOLINT(concurrency-mt-unsafe): only read
  if (wanted == nullptr) return NativeCodeUse::when_worthwhile;
  constexpr std::array every_use{NativeCodeUse::when_worthwhile, NativeCodeUse::never, NativeCodeUse::always};
  return one_of(every_use, name_of_use, wanted, "DMOCBENCH_NATIVE_CODE: there is no");
}

}  // namespace dmocbench
