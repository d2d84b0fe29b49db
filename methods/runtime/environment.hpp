#pragma once

namespace dmocbench {

/// Throws `Error` where DMOCBENCH_THREADS, DMOCBENCH_INSTRUCTION_SET or DMOCBENCH_NATIVE_CODE asks for what there is
/// not: what every program asks before it does anything.
void check_environment();

}  // namespace dmocbench
