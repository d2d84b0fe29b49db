#include <array>

#include "bench/extensions/claims_of_extensions.hpp"
#include "bench/programs.hpp"

namespace dmocbench {

namespace low_thrust_program {
int run(int argc, char** argv);
}
namespace primitives_program {
int run(int argc, char** argv);
}
namespace read_sol_program {
int run(int argc, char** argv);
}
namespace step_control_program {
int run(int argc, char** argv);
}
namespace write_nl_program {
int run(int argc, char** argv);
}

void register_extensions() {
  static constexpr std::array added{
      Program{"low_thrust", "Low-thrust transfers over many revolutions with few steps per revolution",
              low_thrust_program::run},
      Program{"primitives", "Global minima from roadmaps of DMOC primitives, compared with multi-start solves",
              primitives_program::run},
      Program{"read-sol", "Reads and checks the solution of another solver", read_sol_program::run},
      Program{"step_control", "Step sizes that depend on the trajectory, imposed or varied with the action",
              step_control_program::run},
      Program{"write-nl", "Writes a program and its start in AMPL's format", write_nl_program::run}};
  add_programs(added);
  add_claims(primitives_claims());
  add_claims(step_control_claims());
  add_claims(low_thrust_claims());
}

}  // namespace dmocbench
