#pragma once

#include <memory>
#include <string_view>

#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/judgement/kkt_residual.hpp"
#include "methods/transcription/costates.hpp"
#include "methods/transcription/derivatives/back_ends.hpp"

// The functions whose callers tests_under_mutation diverts (ld, option --wrap): in all other object files a call of the
// function is a call of __wrap_<name> (`mutable_…` below, defined in mutations.cpp), and __real_<name> is the function
// itself (`true_…`). CMakeLists.txt reads the linker's names from here. One that has gone stale, because the function
// has got other parameters, is an undefined reference: nm -C libdmocbench_<folder>.a shows the new one next to the old.
// Calls within the function's own source are not diverted, nor are virtual ones: hence functions that hand out objects.
// A member function is stated as it is called, with the object first.

// clang-format off
// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): the linker's names have to be literals
#define DMOCBENCH_WRAPPED(result, name, parameters, symbol) \
  result true_##name parameters asm("__real_" symbol);      \
  result mutable_##name parameters asm("__wrap_" symbol)

namespace dmocbench::mutations {

DMOCBENCH_WRAPPED(std::unique_ptr<Element>, make_element, (std::string_view name),
  "_ZN9dmocbench12make_elementESt17basic_string_viewIcSt11char_traitsIcEE");

DMOCBENCH_WRAPPED(Tableau, gauss_tableau, (int stages),
  "_ZN9dmocbench13gauss_tableauEi");

DMOCBENCH_WRAPPED(Tableau, lobatto_tableau, (int stages, bool shares_controls),
  "_ZN9dmocbench15lobatto_tableauEib");

DMOCBENCH_WRAPPED(TracedProblem::Values, formulas_at, (const TracedProblem* problem, const ControlledState& point),
  "_ZNK9dmocbench13TracedProblem2atERKNS_15ControlledStateE");

DMOCBENCH_WRAPPED(void, construct_transcription, (Transcription* self, const Problem& problem, const Element& element, Tableau tableau, const Grid& grid, std::string_view derivatives, CostForm form),
  "_ZN9dmocbench13TranscriptionC1ERKNS_7ProblemERKNS_7ElementENS_7TableauERKNS_4GridESt17basic_string_viewIcSt11char_traitsIcEENS_8CostFormE");

DMOCBENCH_WRAPPED(std::unique_ptr<DerivativeBackEnd>, make_derivative_back_end, (std::string_view name, const LocalFunctions& functions, const DerivativePlaces& places),
  "_ZN9dmocbench24make_derivative_back_endESt17basic_string_viewIcSt11char_traitsIcEERKNS_14LocalFunctionsERKNS_16DerivativePlacesE");

DMOCBENCH_WRAPPED(Costates, costates, (Transcription& transcription, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers, const Eigen::MatrixXd& v),
  "_ZN9dmocbench8costatesERNS_13TranscriptionERKN5Eigen6MatrixIdLin1ELi1ELi0ELin1ELi1EEES6_RKNS3_IdLin1ELin1ELi0ELin1ELin1EEE");

DMOCBENCH_WRAPPED(KktResidual, kkt_residual, (NonlinearProgram& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers, KktMemory& memory),
  "_ZN9dmocbench12kkt_residualERNS_16NonlinearProgramERKN5Eigen6MatrixIdLin1ELi1ELi0ELin1ELi1EEES6_RNS_9KktMemoryE");

DMOCBENCH_WRAPPED(void, judge, (Confirmation* self, double tolerance, Solution& solution, bool asks_newton),
  "_ZN9dmocbench12Confirmation5judgeEdRNS_8SolutionEb");

DMOCBENCH_WRAPPED(ReplayError, replay_error, (const Problem& problem, const Trajectory& trajectory, double tolerance),
  "_ZN9dmocbench12replay_errorERKNS_7ProblemERKNS_10TrajectoryEd");

DMOCBENCH_WRAPPED(MomentumConsistency, momentum_consistency, (const Problem& problem, const Trajectory& trajectory),
  "_ZN9dmocbench20momentum_consistencyERKNS_7ProblemERKNS_10TrajectoryE");

}  // namespace dmocbench::mutations
// clang-format on
