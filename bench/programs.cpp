#include "bench/programs.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace dmocbench {

namespace adaptive_program {
int run(int argc, char** argv);
}
namespace certify_program {
int run(int argc, char** argv);
}
namespace claims_program {
int run(int argc, char** argv);
}
namespace closed_loop_program {
int run(int argc, char** argv);
}
namespace coercivity_program {
int run(int argc, char** argv);
}
namespace cold_start_program {
int run(int argc, char** argv);
}
namespace consistency_program {
int run(int argc, char** argv);
}
namespace consistency_order_program {
int run(int argc, char** argv);
}
namespace convergence_program {
int run(int argc, char** argv);
}
namespace derivatives_program {
int run(int argc, char** argv);
}
namespace equivalence_program {
int run(int argc, char** argv);
}
namespace error_constants_program {
int run(int argc, char** argv);
}
namespace iterations_program {
int run(int argc, char** argv);
}
namespace list_program {
int run(int argc, char** argv);
}
namespace local_minima_program {
int run(int argc, char** argv);
}
namespace misprints_program {
int run(int argc, char** argv);
}
namespace new_program {
int run(int argc, char** argv);
}
namespace objective_program {
int run(int argc, char** argv);
}
namespace profile_program {
int run(int argc, char** argv);
}
namespace report_program {
int run(int argc, char** argv);
}
namespace rigid_body_coordinates_program {
int run(int argc, char** argv);
}
namespace sequence_program {
int run(int argc, char** argv);
}
namespace shooting_program {
int run(int argc, char** argv);
}
namespace smoothness_program {
int run(int argc, char** argv);
}
namespace solve_program {
int run(int argc, char** argv);
}
namespace invariants_program {
int run(int argc, char** argv);
}
namespace savings_by_solver_program {
int run(int argc, char** argv);
}
namespace study_program {
int run(int argc, char** argv);
}
namespace sweep_program {
int run(int argc, char** argv);
}

namespace {

constexpr std::array core_programs{
    Program{"adaptive", "Measures the error estimate of adaptive grids and the number of intervals saved",
            adaptive_program::run},
    Program{"certify", "Computes the optimal cost with independent methods", certify_program::run},
    Program{"claims", "Compares the paper's statements with the measurements and prints the verdicts",
            claims_program::run},
    Program{"closed_loop", "Drives an exact plant with disturbances using plans that are renewed at every sample",
            closed_loop_program::run},
    Program{"coercivity", "Measures the coercivity of the discrete optimum", coercivity_program::run},
    Program{"cold_start", "Measures success rates of solves from perturbed guesses", cold_start_program::run},
    Program{"consistency", "Compares the change of momentum with the forces", consistency_program::run},
    Program{"consistency_order",
            "Measures orders of consistency of DMOC's discrete Lagrangian, forces, Legendre transforms and map",
            consistency_order_program::run},
    Program{"convergence", "Measures errors and orders of convergence, and the cost of equal accuracy",
            convergence_program::run},
    Program{"derivatives", "Compares exact derivatives with finite differences", derivatives_program::run},
    Program{"equivalence", "Compares the discrete solutions of DMOC and collocation", equivalence_program::run},
    Program{"error_constants", "Predicts errors to leading order from the exact optimum and measures them",
            error_constants_program::run},
    Program{"iterations", "Measures iterations, evaluations and times of solves", iterations_program::run},
    Program{"list", "Lists problems, methods, tableaus, solvers and derivative back ends", list_program::run},
    Program{"local_minima", "Finds local minima and the number of starts that end in each", local_minima_program::run},
    Program{"misprints", "Evaluates each misprinted formula of the paper as printed and as corrected",
            misprints_program::run},
    Program{"new", "Writes the skeleton of a problem and its CMakeLists.txt", new_program::run},
    Program{"objective", "Computes the optimal cost over the number of intervals", objective_program::run},
    Program{"profile", "Measures success, speed and accuracy of every method on all problems", profile_program::run},
    Program{"report", "Writes one HTML page with the claims, figures, tables and trajectories of a results folder",
            report_program::run},
    Program{"rigid_body_coordinates", "Solves one slew of a rigid body in five systems of coordinates",
            rigid_body_coordinates_program::run},
    Program{"sequence", "Solves sequences of problems, each started from the previous solution", sequence_program::run},
    Program{"shooting", "Compares sizes and condition numbers of DMOC and shooting", shooting_program::run},
    Program{"smoothness", "Measures orders of convergence for nonsmooth and smooth optimal controls",
            smoothness_program::run},
    Program{"solve", "Solves problems and writes the trajectories", solve_program::run},
    Program{"invariants", "Measures invariants of the discrete flows: momentum, symplecticity, energy",
            invariants_program::run},
    Program{"savings_by_solver", "Measures the savings of DMOC with different solvers", savings_by_solver_program::run},
    Program{"study", "Studies one problem: trajectory, orders, invariants, local minima, figures", study_program::run},
    Program{"sweep", "Solves one problem for many values of parameters and end states", sweep_program::run},
};

std::vector<Program>& all_programs() {
  static std::vector<Program> all(core_programs.begin(), core_programs.end());
  return all;
}

}  // namespace

std::span<const Program> programs() { return all_programs(); }

void add_programs(std::span<const Program> added) {
  std::vector<Program>& all = all_programs();
  all.insert(all.end(), added.begin(), added.end());
  std::ranges::sort(all, {}, &Program::name);
}

}  // namespace dmocbench
