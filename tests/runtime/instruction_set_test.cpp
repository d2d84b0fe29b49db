#include "methods/runtime/instruction_set.hpp"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "methods/expression/tape.hpp"
#include "methods/kkt/intervals/segment_group.hpp"
#include "methods/runtime/vector_loops.hpp"

namespace dmocbench {
namespace {

/// This test is a program of its own: `vector_loops` chooses its instruction set at the first call and keeps it, so
/// that no other test may call it before.
TEST(InstructionSet, OneOverrideGovernsTapesVectorLoopsAndSegmentKernels) {
  for (const InstructionSet set : available_instruction_sets()) {
    setenv("DMOCBENCH_INSTRUCTION_SET", std::string(name_of(set)).c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
    EXPECT_EQ(preferred_instruction_set(), set);
    EXPECT_EQ(Tape(Schedule()).instruction_set(), set);
    const kkt::Shape shape{};
    EXPECT_EQ(kkt::segment_kernel_for(shape).backward, kkt::segment_kernels_of(set)(shape).backward);
    EXPECT_EQ(&vector_loops(), &vector_loops_of(available_instruction_sets().front()));
  }
}

}  // namespace
}  // namespace dmocbench
