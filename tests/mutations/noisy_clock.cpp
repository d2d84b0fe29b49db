// A clock for experiments whose speed changes all the time, if DMOCBENCH_MUTATION is "noisy_clock"; the linker puts it
// in place of the true one.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string_view>

namespace dmocbench::mutations {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

Clock::time_point true_now() asm("__real__ZNSt6chrono3_V212steady_clock3nowEv");
Clock::time_point noisy_now() asm("__wrap__ZNSt6chrono3_V212steady_clock3nowEv");

namespace {

/// Runs up to eight times too fast or too slow, for longer than a round of short solves takes.
class NoisyClock {
 public:
  Clock::time_point now() {
    const Clock::time_point truly = true_now();
    told_ += speed_ * Seconds(truly - last_);
    last_ = truly;
    if (truly > change_) {
      constexpr double doublings = 3.0;
      speed_ = std::exp2(std::uniform_real_distribution(-doublings, doublings)(engine_));
      change_ = truly + std::chrono::milliseconds(50);
    }
    return Clock::time_point(std::chrono::duration_cast<Clock::duration>(told_));
  }

 private:
  std::mt19937 engine_{1U};
  Clock::time_point last_ = true_now();
  Clock::time_point change_ = last_;
  Seconds told_{last_.time_since_epoch()};
  double speed_ = 1.0;
};

}  // namespace

Clock::time_point noisy_now() {
  static const char* const choice = std::getenv("DMOCBENCH_MUTATION");
  if (choice == nullptr || std::string_view(choice) != "noisy_clock") return true_now();
  static NoisyClock clock;
  return clock.now();
}

}  // namespace dmocbench::mutations
