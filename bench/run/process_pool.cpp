#include "bench/run/process_pool.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/run/error_sentences.hpp"
#include "bench/run/interrupt.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// A worker process: its number, and the pipe for its error message.
struct Worker {
  std::size_t number = 0;
  int complaint = -1;
};

/// All that a child process does. It ends with its parent, even where that is killed.
[[noreturn]] void work_in_child(const Worker& worker, pid_t parent, const std::function<void(std::size_t)>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // NOLINT(cppcoreguidelines-pro-type-vararg)
  if (::getppid() != parent) _exit(1);
  int code = 0;
  try {
    work(worker.number);
  } catch (const std::exception& error) {
    const std::string sentence = sentence_of(error);
    code = ::write(worker.complaint, sentence.data(), sentence.size()) < 0 ? 2 : 1;
  }
  std::fflush(nullptr);
  _exit(code);  // the parent's buffers and exit handlers are not ours
}

/// Waits for one of the children and forwards interrupts meanwhile. The terminal sends Ctrl-C to all processes, but a
/// signal to this one alone would not reach them. Returns the child and its error, which is empty on success.
std::pair<Worker, std::string> wait_for_one(std::map<pid_t, Worker>& running) {
  constexpr std::chrono::milliseconds pause(20);
  for (bool told = false;; std::this_thread::sleep_for(pause)) {
    if (interrupt_requested() && !std::exchange(told, true)) {
      for (const auto& [child, worker] : running) kill(child, SIGTERM);
    }
    int state = 0;
    const pid_t ended = waitpid(-1, &state, WNOHANG);
    if (ended < 0 && errno != EINTR) throw Error("could not wait for a worker process");
    const auto child = running.extract(ended);
    if (!child) continue;
    std::array<char, 4096> sentence{};  // fits into the pipe, so that no process waits to be heard
    const ssize_t size = ::read(child.mapped().complaint, sentence.data(), sentence.size());
    ::close(child.mapped().complaint);
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return {child.mapped(), ""};
    return {child.mapped(), size > 0             ? std::string(sentence.data(), static_cast<std::size_t>(size))
                            : WIFSIGNALED(state) ? fmt::format("it was terminated by signal {}", WTERMSIG(state))
                                                 : "it reported no reason"};
  }
}

}  // namespace

void for_each_in_processes(std::size_t count, std::size_t jobs, const std::function<void(std::size_t)>& work,
                           const std::function<void(std::size_t)>& done) {
  std::map<pid_t, Worker> running;
  std::exception_ptr failure;  // the first one; it is thrown when all processes have ended
  const auto attempt = [&failure](const auto& step) {
    try {
      step();
    } catch (const std::exception&) {
      if (!failure) failure = std::current_exception();
    }
  };
  const auto begin = [&](std::size_t number) {
    std::array<int, 2> complaint{};
    if (::pipe(complaint.data()) != 0) throw Error("cannot create a pipe to a worker process; try --jobs 1");
    std::fflush(nullptr);
    const pid_t parent = ::getpid();
    const pid_t child = fork();
    if (child == 0) work_in_child({number, complaint[1]}, parent, work);
    ::close(complaint[1]);
    if (child < 0) ::close(complaint[0]);
    if (child < 0) throw Error("cannot create a worker process; try --jobs 1");
    running.emplace(child, Worker{number, complaint[0]});
  };
  for (std::size_t next = 0;;) {
    while (next < count && running.size() < jobs && !interrupt_requested() && !failure) {
      attempt([&] { begin(next++); });
    }
    if (running.empty()) break;
    const auto [worker, reason] = wait_for_one(running);
    attempt([&reason = reason] {
      if (reason.empty() || interrupt_requested()) return;
      throw Error("a worker process failed: {}; its finished rows are kept", reason);
    });
    attempt([&, number = worker.number] { done(number); });
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace dmocbench
