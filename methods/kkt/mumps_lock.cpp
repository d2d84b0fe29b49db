#include "methods/kkt/mumps_lock.hpp"

#include <chrono>
#include <thread>

namespace dmocbench {

std::unique_lock<std::recursive_mutex> lock_mumps(const std::function<bool()>& gives_up) {
  static std::recursive_mutex mutex;
  if (!gives_up) return std::unique_lock(mutex);
  std::unique_lock lock(mutex, std::try_to_lock);
  while (!lock && !gives_up()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    lock.try_lock();
  }
  return lock;
}

}  // namespace dmocbench
