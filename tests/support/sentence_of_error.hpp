#pragma once

#include <initializer_list>
#include <string>

#include <gtest/gtest.h>

#include "methods/error.hpp"

namespace dmocbench::tests {

/// For `EXPECT_PRED2`, which shows both where the sentence does not contain the part.
inline bool says(const std::string& sentence, const std::string& part) {
  return sentence.find(part) != std::string::npos;
}

/// What the `Error` that a call throws says; the test fails if it throws none.
template <class Call>
std::string sentence_of_error(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "expected an Error";
  return "";
}

/// The call throws an `Error` whose sentence contains every one of `parts`.
template <class Call>
void expect_error_naming(std::initializer_list<std::string> parts, const Call& call) {
  const std::string sentence = sentence_of_error(call);
  for (const std::string& part : parts) EXPECT_PRED2(says, sentence, part);
}

}  // namespace dmocbench::tests
