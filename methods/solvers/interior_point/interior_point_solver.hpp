#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// The choices of a user of `InteriorPointSolver`.
struct InteriorPointOptions {
  /// The factorisation of the linear systems.
  enum class Factorisation : std::uint8_t {
    intervals,  ///< interval by interval; a program whose structure does not allow it is rejected
    sparse,     ///< by MUMPS, for any program
  };
  Factorisation factorisation = Factorisation::intervals;  ///< the factorisation that is tried first
};

/// The factorisation with that name, "intervals" or "sparse". Throws `Error` that lists the names if there is none.
[[nodiscard]] InteriorPointOptions::Factorisation factorisation_named(std::string_view name);

/// The options from their names: factorisation=intervals|sparse. Throws `Error` on another name or value.
[[nodiscard]] InteriorPointOptions interior_point_options(const NamedOptions& named);

/// The same of options that another solver has a share in, which comes second.
[[nodiscard]] std::pair<InteriorPointOptions, NamedOptions> interior_point_options_among(const NamedOptions& named);

/// Our interior-point method, whose linear systems are solved interval by interval; see interior_point/README.md. A
/// program whose structure does not allow the factorisation ends with the status "invalid program".
class InteriorPointSolver final : public Solver {
 public:
  /// Throws `Error` if an option is out of range.
  explicit InteriorPointSolver(SolverOptions options = {}, InteriorPointOptions choices = {});

  [[nodiscard]] std::unique_ptr<PreparedRun> prepare(CountedProgram& program) const override;

 private:
  InteriorPointOptions choices_;
};

}  // namespace dmocbench
