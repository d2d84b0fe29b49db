#include "methods/transcription/derivatives/back_ends.hpp"

#include <array>

#include "methods/choose.hpp"
#include "methods/transcription/derivatives/finite_differences.hpp"

namespace dmocbench {

#ifdef DMOCBENCH_WITH_ADOLC
std::unique_ptr<DerivativeBackEnd> make_adolc_derivatives(const LocalFunctions& functions,
                                                          const DerivativePlaces& places);  // adolc_derivatives.cpp
std::unique_ptr<DerivativeBackEnd> make_adolc_whole_derivatives(
    const LocalFunctions& functions, const DerivativePlaces& places);  // adolc_whole_derivatives.cpp
#endif

namespace {

/// Exact derivatives: the symbolic ones of `IntervalFunctions`, each a tape over all intervals. Allocates nothing.
class TapeDerivatives final : public DerivativeBackEnd {
 public:
  TapeDerivatives(const LocalFunctions& functions, const DerivativePlaces& places)
      : gradient_(functions.gradient.schedule, places.gradient),
        jacobian_(functions.jacobian.schedule, places.jacobian),
        hessian_(functions.hessian.schedule, places.hessian) {}

  void gradient(Inputs inputs, VectorOut result) override { gradient_.evaluate(inputs, result); }
  void jacobian(Inputs inputs, VectorOut values) override { jacobian_.evaluate(inputs, values); }
  void hessian(Inputs inputs, VectorOut values) override { hessian_.evaluate(inputs, values); }

 private:
  AssembledTape gradient_;
  AssembledTape jacobian_;
  AssembledTape hessian_;
};

using BackEndPtr = std::unique_ptr<DerivativeBackEnd>;

struct Entry {
  std::string_view name;
  std::string_view description;
  BackEndPtr (*make)(const LocalFunctions&, const DerivativePlaces&);
};

BackEndPtr make_tape(const LocalFunctions& functions, const DerivativePlaces& places) {
  return std::make_unique<TapeDerivatives>(functions, places);
}

template <DifferenceKind kind>
BackEndPtr make_differences(const LocalFunctions& functions, const DerivativePlaces& places) {
  return make_finite_differences(functions, places, kind);
}

// One line per back end, the default first.
constexpr auto back_ends = std::to_array<Entry>({
    {"tape", "exact: symbolic derivatives of the formulas of one interval, evaluated for all intervals at once",
     make_tape},
#ifdef DMOCBENCH_WITH_ADOLC
    {"adolc", "exact: ADOL-C's drivers on the formulas of one interval, interval by interval", make_adolc_derivatives},
    {"adolc_whole", "exact: ADOL-C's drivers on the whole program, recorded once; colouring compresses the columns",
     make_adolc_whole_derivatives},
#endif
    {"finite_differences", "central differences of values; perturbs a local unknown of all intervals at once",
     make_differences<DifferenceKind::central>},
    {"forward_differences", "one-sided differences of values, with half the evaluations and half the digits",
     make_differences<DifferenceKind::forward>},
    {"dense_differences", "one-sided differences of the values of the whole program; perturbs one unknown at a time",
     make_dense_differences},
});

constexpr auto back_end_name = [](const Entry& entry) { return entry.name; };

const Entry& entry_named(std::string_view name) {
  std::string refusal = "there is no derivative back end";
#ifndef DMOCBENCH_WITH_ADOLC
  if (name.starts_with("adolc"))
    refusal = "this build lacks ADOL-C (install it and configure again), which is needed by";
#endif
  return one_of(back_ends, back_end_name, name, refusal);
}

}  // namespace

std::vector<std::string> derivative_back_end_names() { return names_of(back_ends, back_end_name); }

std::string derivative_back_end_description(std::string_view name) {
  return std::string(entry_named(name).description);
}

BackEndPtr make_derivative_back_end(std::string_view name, const LocalFunctions& functions,
                                    const DerivativePlaces& places) {
  return entry_named(name).make(functions, places);
}

}  // namespace dmocbench
