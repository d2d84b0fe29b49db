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

/// The processes that are at work.
class Workers {
 public:
  [[nodiscard]] std::size_t count() const { return running_.size(); }

  void begin(std::size_t number, const std::function<void(std::size_t)>& work) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) throw Error("cannot make a process to work in; try --jobs 1");
    if (child == 0) live(number, work);
    running_.emplace(child, number);
  }

  struct Ended {
    std::size_t number;
    bool returned;  // as it should
  };
  /// Waits for one of them; hands an interrupt on while waiting.
  Ended wait_for_one() {
    constexpr std::chrono::milliseconds pause(20);
    for (;; std::this_thread::sleep_for(pause)) {
      if (interrupt_requested()) stop();
      int state = 0;
      const pid_t ended = waitpid(-1, &state, WNOHANG);
      if (ended < 0 && errno != EINTR) throw Error("lost sight of a process that works");
      const auto found = running_.find(ended);
      if (found == running_.end()) continue;
      const std::size_t number = found->second;
      running_.erase(found);
      return {number, WIFEXITED(state) && WEXITSTATUS(state) == 0};
    }
  }

 private:
  /// The terminal tells all processes of Ctrl-C; a signal to this one alone would not reach them.
  void stop() {
    if (std::exchange(stopped_, true)) return;
    for (const auto& [child, number] : running_) kill(child, SIGTERM);
  }

  std::map<pid_t, std::size_t> running_;
  bool stopped_ = false;
};

}  // namespace

void for_each_in_processes(std::size_t count, std::size_t jobs, const std::function<void(std::size_t)>& work,
                           const std::function<void(std::size_t)>& done) {
  Workers workers;
  std::exception_ptr failure;  // the first; whoever is at work is waited for all the same
  const auto attempt = [&failure](const std::function<void()>& step) {
    try {
      step();
    } catch (const std::exception&) {
      if (!failure) failure = std::current_exception();
    }
  };
  std::size_t next = 0;
  for (;;) {
    while (next < count && workers.count() < jobs && !interrupt_requested() && !failure) {
      attempt([&] { workers.begin(next++, work); });
    }
    if (workers.count() == 0) break;
    const Workers::Ended ended = workers.wait_for_one();
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
