#pragma once

#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>

#include "methods/runtime/parallel.hpp"

namespace dmocbench::tests {

/// While it lives, this many threads work on a program.
class Threads {
 public:
  explicit Threads(std::size_t count) : before_(thread_count()) { set_thread_count(count); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
  ~Threads() { set_thread_count(before_); }

 private:
  std::size_t before_;
};

/// A variable of the environment that is again what it was when this ends. For tests of one thread.
class EnvironmentVariable {
 public:
  explicit EnvironmentVariable(const char* name) : name_(name), before_(value()) {}
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;
  ~EnvironmentVariable() {
    unset();
    if (before_) set(*before_);
  }

  // NOLINTBEGIN(concurrency-mt-unsafe): one thread
  void set(const std::string& value) const { setenv(name_, value.c_str(), 1); }
  void unset() const { unsetenv(name_); }
  [[nodiscard]] std::optional<std::string> value() const {
    const char* const text = std::getenv(name_);
    return text == nullptr ? std::nullopt : std::optional<std::string>(text);
  }
  // NOLINTEND(concurrency-mt-unsafe)

 private:
  const char* name_;
  std::optional<std::string> before_;
};

}  // namespace dmocbench::tests
