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
    Program{"adaptive", "Grids that the error chooses: quality of the estimate, and the intervals that it saves",
            adaptive_program::run},
    Program{"certify", "The least cost of a problem by routes that share as little as possible", certify_program::run},
    Program{"claims", "The table of claims: the paper's statements, the measurements, and the verdicts",
            claims_program::run},
    Program{"coercivity", "Coercivity of the discrete optimum over the number of intervals", coercivity_program::run},
    Program{"cold_start", "How often a solve from a guess, or from a perturbed one, succeeds", cold_start_program::run},
    Program{"consistency", "Momentum-force consistency over the number of intervals", consistency_program::run},
    Program{"consistency_order",
            "The order of consistency of DMOC's discrete Lagrangian, forces, Legendre transforms and map",
            consistency_order_program::run},
    Program{"convergence", "Errors over the step, and the cost of accuracy", convergence_program::run},
    Program{"derivatives", "The value of exact derivatives compared with differences", derivatives_program::run},
    Program{"equivalence",
            "DMOC and Hamiltonian collocation with the same tableau describe the same discrete solutions",
            equivalence_program::run},
    Program{"iterations", "Iteration counts, evaluations and times of solves", iterations_program::run},
    Program{"list",
            "Lists problems with their data and their known optimum, methods, tableaus, solvers, derivative back ends",
            list_program::run},
    Program{"local_minima", "Which local minima there are and how often each method falls into which",
            local_minima_program::run},
    Program{"misprints", "The misprints of the paper, each formula evaluated as printed and as corrected",
            misprints_program::run},
    Program{"new", "Writes the header of a problem to begin with, and the CMakeLists.txt that makes a library of it",
            new_program::run},
    Program{"objective", "The optimal cost over the number of intervals", objective_program::run},
    Program{"profile", "All problems by every method from the problems' own guesses: success, speed and accuracy",
            profile_program::run},
    Program{"report", "A results folder as one page of HTML that opens anywhere: claims, figures, tables, motions",
            report_program::run},
    Program{"sequence", "Problems that follow each other, each started from the answer of the one before",
            sequence_program::run},
    Program{"shooting", "The programs of DMOC, multiple and single shooting at one optimum", shooting_program::run},
    Program{"smoothness", "Orders for nonsmooth and smooth optimal controls", smoothness_program::run},
    Program{"solve", "One or more solutions, written out as motions: nodes, stages and the quantities of a picture",
            solve_program::run},
    Program{"invariants", "The invariants of the discrete flows: momentum, symplecticity, energy",
            invariants_program::run},
    Program{"savings_by_solver", "How much of DMOC's saving is due to the method, and how much to the solver",
            savings_by_solver_program::run},
    Program{"study", "Everything about one problem: motion, orders, invariants, minima, figures, and a report",
            study_program::run},
    Program{"sweep", "A study of parameters: one problem with other masses, lengths, weights or end states",
            sweep_program::run},
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
