#pragma once

/// Stands before a loop whose iterations read no results of each other, so that the compiler may carry out
/// several at once without looking whether arrays overlap. (clang looks when the program runs.)
// NOLINTBEGIN(cppcoreguidelines-macro-usage): a pragma
#ifdef __clang__
#define DMOCBENCH_INDEPENDENT_ITERATIONS
#else
#define DMOCBENCH_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#endif
// NOLINTEND(cppcoreguidelines-macro-usage)
