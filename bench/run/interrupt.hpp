#pragma once

#include <array>
#include <csignal>
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

 private:
  std::array<struct sigaction, 3> before_{};
};

/// True once a stop has been requested.
[[nodiscard]] bool interrupt_requested() noexcept;

/// A stop was requested before there was anything to keep. `run_program` reports this and returns 130.
struct Interrupted final : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted before the results were complete; nothing was written") {}
};

/// Throws `Interrupted` once a stop has been requested.
void throw_if_interrupted();

}  // namespace dmocbench
