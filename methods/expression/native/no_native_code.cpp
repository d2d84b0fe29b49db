// Instead of native_code.cpp where there is no xbyak, or another processor: tapes are interpreted.
#include "methods/expression/native/native_code.hpp"

namespace dmocbench {

bool has_native_code(InstructionSet /*set*/) noexcept { return false; }

std::unique_ptr<const NativeCode> make_native_code(const NativePlan& /*plan*/, InstructionSet /*set*/) {
  return nullptr;
}

}  // namespace dmocbench
