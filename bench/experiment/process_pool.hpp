#pragma once

#include <cstddef>
#include <functional>

namespace dmocbench {

/// From now on Ctrl-C (SIGINT) and SIGTERM ask for a stop instead of ending the program; a second one ends it.
void listen_for_interrupt();

/// True once a stop has been asked for.
[[nodiscard]] bool interrupt_requested() noexcept;

/// Calls `work(i)` for i = 0 .. count - 1, each in a process of its own, at most `jobs` of them at a time, and
/// `done(i)` here after each has ended. Processes, not threads: the sparse factorisation below Ipopt is not made for
/// threads.
///
/// An interrupt reaches the processes too; those that have not begun then are not begun. What a process finds it has to
/// write to a file. Throws `Error`, once all have ended, if a process cannot be made, `done` throws, or one ends other
/// than by returning.
void for_each_in_processes(std::size_t count, std::size_t jobs, const std::function<void(std::size_t)>& work,
                           const std::function<void(std::size_t)>& done);

}  // namespace dmocbench
