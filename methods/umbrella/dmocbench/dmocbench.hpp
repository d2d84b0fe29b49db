#pragma once

// For a program that states and solves its own problems: `#include <dmocbench/dmocbench.hpp>` and the
// target dmocbench::dmocbench. A library of problems includes <dmocbench/problem.hpp> only, your own experiment
// <dmocbench/experiment.hpp>.
#include <Eigen/Geometry>
#include <dmocbench/problem.hpp>
#include <dmocbench/version.hpp>

#include "methods/adaptive/adaptive_solve.hpp"
#include "methods/diagnostics/accuracy.hpp"
#include "methods/diagnostics/element_identities.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/diagnostics/trajectory_error.hpp"
#include "methods/diagnostics/violation_between_stages.hpp"
#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/vectors.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/sensitivity/feedback_gains.hpp"
#include "methods/sensitivity/sensitivities.hpp"
#include "methods/solvers/batch/solve_batch.hpp"
#include "methods/solvers/prepared_solve.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/tables/motion_file.hpp"
#include "methods/transcription/describe_violation.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/sample_multipliers.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
