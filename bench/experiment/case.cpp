#include "bench/experiment/case.hpp"

#include <fmt/format.h>

namespace dmocbench {

std::unique_ptr<Transcription> Case::transcribe() const {
  return std::make_unique<Transcription>(*problem, *make_element(method), make_tableau(tableau, stages), grid,
                                         derivatives, form);
}

std::string Case::label() const {
  return fmt::format("{} {} {} {} {} {}{}{} N = {}", problem->name(), method, tableau, stages, solver, derivatives,
                     variant.empty() ? "" : " ", variant, intervals());
}

std::string Case::file_label() const {
  return fmt::format("{}_{}_{}{}_{}{}", problem->name(), method, tableau, stages, intervals(),
                     derivatives == "tape" ? "" : "_" + derivatives);
}

bool Case::same_curve(const Case& other) const {
  return problem == other.problem && method == other.method && tableau == other.tableau && stages == other.stages &&
         solver == other.solver && derivatives == other.derivatives && variant == other.variant;
}

}  // namespace dmocbench
