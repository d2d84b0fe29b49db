#include "bench/run/interrupt.hpp"

namespace dmocbench {

namespace {

constexpr std::array interrupts{SIGINT, SIGHUP, SIGTERM};

volatile std::sig_atomic_t requested = 0;

extern "C" void on_signal(int signal) {
  requested = 1;
  std::signal(signal, SIG_DFL);  // the next one ends the program
}

}  // namespace

ListeningScope::ListeningScope() {
  for (std::size_t i = 0; i < before_.size(); ++i) ::sigaction(interrupts[i], nullptr, &before_[i]);
}

ListeningScope::~ListeningScope() {
  for (std::size_t i = 0; i < before_.size(); ++i) ::sigaction(interrupts[i], &before_[i], nullptr);
  requested = 0;
}

void listen_for_interrupt() {
  for (const int signal : interrupts) {
    if (std::signal(signal, on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

bool interrupt_requested() noexcept { return requested != 0; }

void throw_if_interrupted() {
  if (interrupt_requested()) throw Interrupted();
}

}  // namespace dmocbench
