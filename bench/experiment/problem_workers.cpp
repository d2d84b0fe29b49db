#include "bench/experiment/problem_workers.hpp"

#include <cerrno>
#include <cstdio>
#include <exception>
#include <map>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/experiment/interrupt.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// The child's whole life.
[[noreturn]] void live(std::size_t number, const std::function<void(std::size_t)>& work) {
  int code = 0;
  try {
    work(number);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    code = 1;
  }
  std::fflush(nullptr);
  _exit(code);  // the parent's buffers and exit handlers are not ours
}

}  // namespace

void for_each_in_processes(std::size_t count, std::size_t jobs, const std::function<void(std::size_t)>& work,
                           const std::function<void(std::size_t)>& done) {
  std::map<pid_t, std::size_t> running;
  std::size_t next = 0;
  bool failed = false;
  while (next < count || !running.empty()) {
    while (next < count && running.size() < jobs && !interrupt_requested() && !failed) {
      std::fflush(nullptr);
      const pid_t child = fork();
      if (child < 0) throw Error("cannot make a process to work in; try --jobs 1");
      if (child == 0) live(next, work);
      running.emplace(child, next++);
    }
    if (running.empty()) break;
    int state = 0;
    const pid_t ended = waitpid(-1, &state, 0);
    if (ended < 0) {
      if (errno == EINTR) continue;
      throw Error("lost sight of a process that works");
    }
    const auto found = running.find(ended);
    if (found == running.end()) continue;
    done(found->second);
    failed = failed || !WIFEXITED(state) || WEXITSTATUS(state) != 0;
    running.erase(found);
  }
  if (failed) throw Error("a process that worked on some rows ended with an error; what it finished is kept");
}

}  // namespace dmocbench
