#include "methods/runtime/native_code_use.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/environment_variable.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

class PreferredNativeCodeUse : public testing::Test {
 protected:
  tests::EnvironmentVariable variable_{"DMOCBENCH_NATIVE_CODE"};
};

TEST_F(PreferredNativeCodeUse, IsByWorthUnlessTheEnvironmentSaysOtherwise) {
  variable_.unset();
  EXPECT_EQ(preferred_native_code_use(), NativeCodeUse::when_worthwhile);
  for (const NativeCodeUse use : {NativeCodeUse::never, NativeCodeUse::always, NativeCodeUse::when_worthwhile}) {
    variable_.set(std::string(name_of_use(use)));
    EXPECT_EQ(preferred_native_code_use(), use);
  }
}

TEST_F(PreferredNativeCodeUse, ThrowsWhenTheEnvironmentNamesNoUse) {
  variable_.set("sometimes");
  tests::expect_error_naming({"DMOCBENCH_NATIVE_CODE", "sometimes", "never", "always"},
                             [] { static_cast<void>(preferred_native_code_use()); });
}

}  // namespace
}  // namespace dmocbench
