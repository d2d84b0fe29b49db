#include "methods/runtime/environment.hpp"

#include <cstdlib>

#include "methods/runtime/instruction_set.hpp"
#include "methods/runtime/parallel.hpp"

namespace dmocbench {

void check_environment() {
  static_cast<void>(thread_count());
  static_cast<void>(preferred_instruction_set());
}

void order_by_one_thread() {
  const int keep_the_choice_of_the_user = 0;
  setenv("SCOTCH_PTHREAD_NUMBER", "1", keep_the_choice_of_the_user);  // NOLINT(concurrency-mt-unsafe): one thread yet
}

}  // namespace dmocbench
