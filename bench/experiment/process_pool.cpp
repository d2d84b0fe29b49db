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

#include "methods/error.hpp"

namespace dmocbench {

namespace {

volatile std::sig_atomic_t requested = 0;

extern "C" void on_signal(int signal) {
  requested = 1;
  std::signal(signal, SIG_DFL);  // the next one ends the program
}

/// All that a child process does.
[[noreturn]] void work_in_child(std::size_t number, const std::function<void(std::size_t)>& work) {
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

/// Waits for one of the children; hands an interrupt on while waiting. The terminal tells all processes of Ctrl-C; a
/// signal to this one alone would not reach them. Returns its number, and whether it ended as it should.
std::pair<std::size_t, bool> wait_for_one(std::map<pid_t, std::size_t>& running) {
  constexpr std::chrono::milliseconds pause(20);
  for (bool told = false;; std::this_thread::sleep_for(pause)) {
    if (interrupt_requested() && !std::exchange(told, true)) {
      for (const auto& [child, number] : running) kill(child, SIGTERM);
    }
    int state = 0;
    const pid_t ended = waitpid(-1, &state, WNOHANG);
    if (ended < 0 && errno != EINTR) throw Error("lost sight of a process that works");
    if (const auto child = running.extract(ended)) return {child.mapped(), WIFEXITED(state) && WEXITSTATUS(state) == 0};
  }
}

}  // namespace

void listen_for_interrupt() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool interrupt_requested() noexcept { return requested != 0; }

void for_each_in_processes(std::size_t count, std::size_t jobs, const std::function<void(std::size_t)>& work,
                           const std::function<void(std::size_t)>& done) {
  std::map<pid_t, std::size_t> running;  // the number that each process works on
  std::exception_ptr failure;            // the first; the processes at work are waited for all the same
  const auto attempt = [&failure](const auto& step) {
    try {
      step();
    } catch (const std::exception&) {
      if (!failure) failure = std::current_exception();
    }
  };
  for (std::size_t next = 0;;) {
    while (next < count && running.size() < jobs && !interrupt_requested() && !failure) {
      std::fflush(nullptr);
      const std::size_t number = next++;
      const pid_t child = fork();
      if (child == 0) work_in_child(number, work);
      attempt([&] {
        if (child < 0) throw Error("cannot make a process to work in; try --jobs 1");
        running.emplace(child, number);
      });
    }
    if (running.empty()) break;
    const auto [number, returned] = wait_for_one(running);
    attempt([&, number = number, returned = returned] {
      done(number);
      if (!returned && !interrupt_requested()) {
        throw Error("a process that worked on some rows ended with an error; what it finished is kept");
      }
    });
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace dmocbench
