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
    Program{"adaptive", "Adaptive grids: quality of the error estimate and number of intervals saved",
            adaptive_program::run},
    Program{"certify", "The optimal cost, computed with independent methods", certify_program::run},
    Program{"claims", "Compares the paper's statements with the measurements and prints the verdicts",
            claims_program::run},
    Program{"coercivity", "Coercivity of the discrete optimum over the number of intervals", coercivity_program::run},
    Program{"cold_start", "Success rates of solves from perturbed guesses", cold_start_program::run},
    Program{"consistency", "Momentum-force consistency over the number of intervals", consistency_program::run},
    Program{"consistency_order",
            "Orders of consistency of DMOC's discrete Lagrangian, forces, Legendre transforms and map",
            consistency_order_program::run},
    Program{"convergence", "Errors and orders of convergence, and the cost of equal accuracy",
            convergence_program::run},
    Program{"derivatives", "Exact derivatives compared with finite differences", derivatives_program::run},
    Program{"equivalence", "Compares the discrete solutions of DMOC and collocation", equivalence_program::run},
    Program{"error_constants", "Errors to leading order, predicted from the exact optimum and measured",
            error_constants_program::run},
    Program{"iterations", "Iteration counts, evaluations and times of solves", iterations_program::run},
    Program{"list", "Lists problems, methods, tableaus, solvers and derivative back ends", list_program::run},
    Program{"local_minima", "Local minima, with the number of starts ending in each", local_minima_program::run},
    Program{"misprints", "Misprints of the paper, each formula evaluated as printed and as corrected",
            misprints_program::run},
    Program{"new", "Writes the skeleton of a problem and its CMakeLists.txt", new_program::run},
    Program{"objective", "The optimal cost over the number of intervals", objective_program::run},
    Program{"profile", "Success, speed and accuracy of every method on all problems", profile_program::run},
    Program{"report", "Writes one HTML page with the claims, figures, tables and trajectories of a results folder",
            report_program::run},
    Program{"rigid_body_coordinates", "One slew of a rigid body in five systems of coordinates, against one optimum",
            rigid_body_coordinates_program::run},
    Program{"sequence", "Sequences of problems, each started from the solution of the previous one",
            sequence_program::run},
    Program{"shooting", "Sizes and condition numbers of DMOC, multiple and single shooting", shooting_program::run},
    Program{"smoothness", "Orders of convergence for nonsmooth and smooth optimal controls", smoothness_program::run},
    Program{"solve", "Solves problems and writes the trajectories", solve_program::run},
    Program{"invariants", "Invariants of the discrete flows: momentum, symplecticity, energy", invariants_program::run},
    Program{"savings_by_solver", "Savings of DMOC with different solvers", savings_by_solver_program::run},
    Program{"study", "A report on one problem: trajectory, orders, invariants, local minima, figures",
            study_program::run},
    Program{"sweep", "Solves one problem for many parameters and end states", sweep_program::run},
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
