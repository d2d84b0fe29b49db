#pragma once

#include <array>
#include <csignal>
#include <cstddef>
#include <functional>
#include <stdexcept>

namespace dmocbench {

/// From now on Ctrl-C (SIGINT), a closed terminal (SIGHUP) and SIGTERM ask for a stop instead of ending the program; a
/// second one ends it. What the caller ignores (nohup) stays ignored.
void listen_for_interrupt();

/// For a program within another one: once it has ended, the signals of `listen_for_interrupt` do what they did before,
/// and no stop has been asked for.
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

/// True once a stop has been asked for.
[[nodiscard]] bool interrupt_requested() noexcept;

/// A stop was asked for before there was anything to keep. `run_program` says so and returns 130.
struct Interrupted final : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted before the results were complete; nothing was written") {}
};

/// Throws `Interrupted` once a stop has been asked for.
void throw_if_interrupted();

/// Calls `work(i)` for i from 0 to count - 1, each in a process of its own, at most `jobs` of them at a time, and
/// `done(i)` here after each has ended. Processes, not threads: the sparse factorisation below Ipopt is not made for
/// threads.
///
/// An interrupt reaches the processes too, and they end with this one; those that have not begun then are not begun.
/// What a process finds it has to write to a file. Throws `Error`, once all have ended, if a process cannot be made,
/// `done` throws, or one ends other than by returning: what it threw is part of the sentence.
void for_each_in_processes(std::size_t count, std::size_t jobs, const std::function<void(std::size_t)>& work,
                           const std::function<void(std::size_t)>& done);

}  // namespace dmocbench
