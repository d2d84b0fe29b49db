#include "methods/transcription/derivative_back_end.hpp"

#include <array>

#include "methods/error.hpp"
#ifdef DMOCBENCH_WITH_ADOLC
#include "methods/transcription/adolc_derivatives.hpp"
#endif
#include "methods/transcription/finite_differences.hpp"
#include "methods/transcription/tape_derivatives.hpp"

namespace dmocbench {

namespace {

using BackEndPtr = std::unique_ptr<DerivativeBackEnd>;

struct Entry {
  std::string_view name;
  std::string_view description;
  BackEndPtr (*make)(const LocalFunctions&, const DerivativePlaces&);
};

template <class Type>
BackEndPtr make(const LocalFunctions& functions, const DerivativePlaces& places) {
  return std::make_unique<Type>(functions, places);
}

template <DifferenceKind kind>
BackEndPtr make_differences(const LocalFunctions& functions, const DerivativePlaces& places) {
  return std::make_unique<FiniteDifferences>(functions, places, kind);
}

// One line per back end, the default first.
constexpr auto back_ends = std::to_array<Entry>({
    {"tape", "exact: the formulas of one interval differentiated symbolically, evaluated for all",
     make<TapeDerivatives>},
#ifdef DMOCBENCH_WITH_ADOLC
    {"adolc", "exact: ADOL-C's drivers on the formulas of one interval, interval after interval",
     make<AdolcDerivatives>},
#endif
    {"finite_differences", "central differences of values, a local unknown of all intervals at once",
     make_differences<DifferenceKind::central>},
    {"forward_differences", "one-sided differences of values, half the evaluations and half the digits",
     make_differences<DifferenceKind::forward>},
});

const Entry& entry_named(std::string_view name) {
  std::string known;
  for (const Entry& entry : back_ends) {
    if (entry.name == name) return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  if (name == "adolc") {
    throw Error("derivatives by \"adolc\" are not in this build; install ADOL-C, configure again, or choose one of " +
                known);
  }
  throw Error("there are no derivatives by \"" + std::string(name) + "\"; choose one of " + known);
}

}  // namespace

std::vector<std::string> derivative_back_end_names() {
  std::vector<std::string> names;
  names.reserve(back_ends.size());
  for (const Entry& entry : back_ends) names.emplace_back(entry.name);
  return names;
}

std::string derivative_back_end_description(std::string_view name) {
  return std::string(entry_named(name).description);
}

BackEndPtr make_derivative_back_end(std::string_view name, const LocalFunctions& functions,
                                    const DerivativePlaces& places) {
  return entry_named(name).make(functions, places);
}

}  // namespace dmocbench
