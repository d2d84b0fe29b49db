#pragma once

#include <array>
#include <csignal>
#include <cstddef>
#include <functional>
#include <stdexcept>

namespace dmocbench {

/// From now on Ctrl-C (SIGINT), a closed terminal (SIGHUP) and SIGTERM request a stop instead of ending the program; a
/// second one ends it. Signals that the caller ignores (nohup) stay ignored.
void listen_for_interrupt();

/// For a program within another one: restores at its end the previous handlers of the signals of
/// `listen_for_interrupt` and clears a requested stop.
class ListeningScope {
 public:
  ListeningScope();
  ~ListeningScope();
  ListeningScope(const ListeningScope&) = delete;
  ListeningScope& operator=(const ListeningScope&) = delete;
  ListeningScope(ListeningScope&&) = delete;
  ListeningScope& operator=(ListeningScope&&) = delete;

 private:
  std::array<struct sigaction, 3> before_;
};

/// True once a stop has been requested.
[[nodiscard]] bool interrupt_requested() noexcept;

/// A stop was requested before there was anything to keep. `run_program` reports this and returns 130.
struct Interrupted final : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted before the results were complete; nothing was written") {}
};

/// Throws `Interrupted` once a stop has been requested.
void throw_if_interrupted();

/// Calls `work(i)` for i from 0 to count - 1, each in a process of its own, at most `jobs` of them at a time, and
/// `done(i)` here after each has ended. Processes, not threads: the sparse factorisation below Ipopt is not made for
/// threads.
///
/// An interrupt reaches the processes too, and they end with this one; those that have not begun then are not begun.
/// A process must write its results to a file. Throws `Error`, once all have ended, if a process cannot be started,
/// `done` throws, or a process does not return normally; the sentence includes the message of its exception.
void for_each_in_processes(std::size_t count, std::size_t jobs, const std::function<void(std::size_t)>& work,
                           const std::function<void(std::size_t)>& done);

}  // namespace dmocbench
