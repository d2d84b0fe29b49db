#pragma once

#include <cstddef>
#include <functional>

namespace dmocbench {

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
