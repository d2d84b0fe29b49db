#include "bench/experiment/process_pool.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <map>
#include <thread>
#include <utility>

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

/// Processes at work and the number that each works on.
using Running = std::map<pid_t, std::size_t>;

void begin(std::size_t number, const std::function<void(std::size_t)>& work, Running& running) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw Error("cannot make a process to work in; try --jobs 1");
  if (child == 0) live(number, work);
  running.emplace(child, number);
}

struct Ended {
  std::size_t number;
  bool returned;  ///< as it should
};

/// Waits for one of them; hands an interrupt on while waiting. The terminal tells all processes of Ctrl-C; a signal to
/// this one alone would not reach them.
Ended wait_for_one(Running& running) {
  constexpr std::chrono::milliseconds pause(20);
  for (bool told = false;; std::this_thread::sleep_for(pause)) {
    if (interrupt_requested() && !std::exchange(told, true)) {
      for (const auto& [child, number] : running) kill(child, SIGTERM);
    }
    int state = 0;
    const pid_t ended = waitpid(-1, &state, WNOHANG);
    if (ended < 0 && errno != EINTR) throw Error("lost sight of a process that works");
    const auto found = running.find(ended);
    if (found == running.end()) continue;
    const std::size_t number = found->second;
    running.erase(found);
    return {number, WIFEXITED(state) && WEXITSTATUS(state) == 0};
  }
}

}  // namespace

void for_each_in_processes(std::size_t count, std::size_t jobs, const std::function<void(std::size_t)>& work,
                           const std::function<void(std::size_t)>& done) {
  Running running;
  std::exception_ptr failure;  // the first; whoever is at work is waited for all the same
  const auto attempt = [&failure](const auto& step) {
    try {
      step();
    } catch (const std::exception&) {
      if (!failure) failure = std::current_exception();
    }
  };
  for (std::size_t next = 0;;) {
    while (next < count && running.size() < jobs && !interrupt_requested() && !failure) {
      attempt([&] { begin(next++, work, running); });
    }
    if (running.empty()) break;
    const Ended ended = wait_for_one(running);
    attempt([&] {
      done(ended.number);
      if (!ended.returned && !interrupt_requested()) {
        throw Error("a process that worked on some rows ended with an error; what it finished is kept");
      }
    });
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace dmocbench
