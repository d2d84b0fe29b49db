#pragma once

/// Placed in front of a loop whose iterations are independent of each other. It lets g++ vectorise the loop without a
/// check that its arrays do not overlap. For clang it expands to nothing: clang checks for overlap at run time.
// NOLINTBEGIN(cppcoreguidelines-macro-usage): a pragma
#ifdef __clang__
#define DMOCBENCH_INDEPENDENT_ITERATIONS
#else
#define DMOCBENCH_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#endif
// NOLINTEND(cppcoreguidelines-macro-usage)
