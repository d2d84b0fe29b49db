#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "methods/solvers/solver.hpp"

namespace dmocbench {

namespace kkt {
class KktSystem;
}

/// The choices of a user of `InteriorPointSolver`.
struct InteriorPointOptions {
  /// How the linear systems are factorised.
  enum class Factorisation : std::uint8_t {
    intervals,  ///< interval by interval; a program whose structure does not allow it is refused
    sparse,     ///< by MUMPS, for any program
  };
  Factorisation factorisation = Factorisation::intervals;  ///< the factorisation that is tried first
  /// Supplies the linear systems of an experiment in place of `factorisation`, one `KktSystem` (kkt_system.hpp) per
  /// solve; it throws `Error` where it has none for the program, which outlives it. Empty for ours.
  std::function<std::unique_ptr<kkt::KktSystem>(NonlinearProgram& program)> make_kkt_system;
};

/// Our interior-point method, whose linear systems are solved interval by interval; see interior_point/README.md.
///
/// `InteriorPointOptions` by name: factorisation=intervals|sparse.
class InteriorPointSolver final : public Solver {
 public:
  /// Throws `Error` on an unknown option passed on, or a value that it does not take.
  explicit InteriorPointSolver(SolverOptions options = {}, InteriorPointOptions choices = {});

  [[nodiscard]] std::string name() const override { return "interior_point"; }
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] std::unique_ptr<PreparedRun> prepare(CountedProgram& program) const override;

 private:
  [[nodiscard]] Solution run(CountedProgram& program, const Eigen::VectorXd& start) const override;

  InteriorPointOptions choices_;
};

}  // namespace dmocbench
