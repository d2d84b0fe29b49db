#include "methods/runtime/environment.hpp"

#include "methods/runtime/instruction_set.hpp"
#include "methods/runtime/native_code_use.hpp"
#include "methods/runtime/parallel.hpp"

namespace dmocbench {

void check_environment() {
  static_cast<void>(thread_count());
  static_cast<void>(preferred_instruction_set());
  static_cast<void>(preferred_native_code_use());
}

}  // namespace dmocbench
