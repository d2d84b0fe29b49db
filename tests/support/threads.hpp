#pragma once

#include <cstddef>

#include "methods/runtime/parallel.hpp"

namespace dmocbench::tests {

/// While it lives, this many threads work on a program.
class Threads {
 public:
  explicit Threads(std::size_t count) : before_(thread_count()) { set_thread_count(count); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
  Threads(Threads&&) = delete;
  Threads& operator=(Threads&&) = delete;
  ~Threads() { set_thread_count(before_); }

 private:
  std::size_t before_;
};

}  // namespace dmocbench::tests
