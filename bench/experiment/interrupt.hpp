#pragma once

namespace dmocbench {

/// From now on Ctrl-C (SIGINT) and SIGTERM ask for a stop instead of ending the program; a second one ends it.
void listen_for_interrupt();

/// True once a stop has been asked for.
[[nodiscard]] bool interrupt_requested() noexcept;

}  // namespace dmocbench
