#include "methods/runtime/native_code_use.hpp"

#include <cstdlib>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

/// DMOCBENCH_NATIVE_CODE is again what it was when the test ends.
class PreferredNativeCodeUse : public testing::Test {
 protected:
  // NOLINTBEGIN(concurrency-mt-unsafe): one thread
  void SetUp() override {
    if (const char* value = std::getenv(variable)) before_ = value;
  }
  void TearDown() override {
    unset();
    if (before_) set(*before_);
  }
  static void set(const std::string& value) { setenv(variable, value.c_str(), 1); }
  static void unset() { unsetenv(variable); }
  // NOLINTEND(concurrency-mt-unsafe)

 private:
  static constexpr const char* variable = "DMOCBENCH_NATIVE_CODE";
  std::optional<std::string> before_;
};

TEST_F(PreferredNativeCodeUse, IsByWorthUnlessTheEnvironmentSaysOtherwise) {
  unset();
  EXPECT_EQ(preferred_native_code_use(), NativeCodeUse::when_worthwhile);
  for (const NativeCodeUse use : {NativeCodeUse::never, NativeCodeUse::always, NativeCodeUse::when_worthwhile}) {
    set(std::string(name_of_use(use)));
    EXPECT_EQ(preferred_native_code_use(), use);
  }
}

TEST_F(PreferredNativeCodeUse, ThrowsWhenTheEnvironmentNamesNoUse) {
  set("sometimes");
  tests::expect_error_naming({"DMOCBENCH_NATIVE_CODE", "sometimes", "never", "always"},
                             [] { static_cast<void>(preferred_native_code_use()); });
}

}  // namespace
}  // namespace dmocbench
