#pragma once

#include <functional>
#include <mutex>

namespace dmocbench {

/// Makes MUMPS this thread's alone until the lock that is returned ends. MUMPS has global state, and so has Ipopt,
/// which calls it: each call of ours holds this one lock of the process, and solves by `ipopt` and `sqp` hold it
/// throughout. A thread that holds it may take it again.
///
/// While another thread has it, `gives_up` is called every millisecond; once that is true, the lock is returned
/// unowned.
[[nodiscard]] std::unique_lock<std::recursive_mutex> lock_mumps(const std::function<bool()>& gives_up = {});

}  // namespace dmocbench
