#pragma once

namespace dmocbench {

/// Throws `Error` if DMOCBENCH_THREADS or DMOCBENCH_INSTRUCTION_SET has a value that is not available here. Every
/// program calls it first.
void check_environment();

/// Lets MUMPS order unknowns on one thread, unless the environment sets SCOTCH_PTHREAD_NUMBER: Scotch 7, which orders
/// for it, takes all processors otherwise, and its order, and with it the last digits of an answer, is not the same in
/// every run. It changes the environment of this process: for `main`, before other threads exist, not for a
/// library.
void order_by_one_thread();

}  // namespace dmocbench
