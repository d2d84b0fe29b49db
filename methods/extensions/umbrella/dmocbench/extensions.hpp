#pragma once

// `#include <dmocbench/extensions.hpp>` and the target dmocbench::extensions: steps tied to the
// motion, roadmaps of DMOC primitives, programs for AMPL's solvers. Only where dmocbench was built with
// DMOCBENCH_EXTENSIONS (the default).
#include <dmocbench/dmocbench.hpp>

#include "methods/extensions/interchange/ampl_answer.hpp"
#include "methods/extensions/interchange/ampl_model.hpp"
#include "methods/extensions/primitives/lattice_roadmap.hpp"
#include "methods/extensions/primitives/primitive_library.hpp"
#include "methods/extensions/primitives/stored_roadmap.hpp"
#include "methods/extensions/step_control/step_control_map.hpp"
#include "methods/extensions/step_control/step_control_program.hpp"
