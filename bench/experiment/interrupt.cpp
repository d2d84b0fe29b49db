#include "bench/experiment/interrupt.hpp"

#include <csignal>

namespace dmocbench {

namespace {

volatile std::sig_atomic_t requested = 0;

extern "C" void on_signal(int signal) {
  requested = 1;
  std::signal(signal, SIG_DFL);  // the next one ends the program
}

}  // namespace

void listen_for_interrupt() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool interrupt_requested() noexcept { return requested != 0; }

}  // namespace dmocbench
