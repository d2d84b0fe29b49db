#pragma once

#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "methods/kkt/kkt_system.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"

namespace dmocbench::interior_point {

/// The solver of the linear systems that the choices name, or a sentence with the reason why the program's structure
/// does not allow it.
[[nodiscard]] tl::expected<std::unique_ptr<kkt::KktSystem>, std::string> make_kkt(NonlinearProgram& program,
                                                                                  const InteriorPointOptions& choices);

}  // namespace dmocbench::interior_point
