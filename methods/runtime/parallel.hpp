#pragma once

#include <cstddef>

namespace dmocbench {

/// The number of threads that work on one program where that pays: the last value of `set_thread_count`, else the
/// environment variable DMOCBENCH_THREADS, else one per processor. Throws `Error` if the variable is not a number from
/// 1 to 1024.
[[nodiscard]] std::size_t thread_count();
/// Throws `Error` unless 1 <= count <= 1024.
void set_thread_count(std::size_t count);

/// A smaller number of intervals is one part: the work on it should take much longer than waking a thread
/// (`build/bench/speed/speed` prints the times per interval).
inline constexpr std::size_t intervals_per_part = 4096;
/// The largest number of parts.
inline constexpr std::size_t most_parts = 64;
/// The number of parts into which intervals are cut. Neither this nor any result depends on the number of threads.
[[nodiscard]] std::size_t part_count(std::size_t intervals, std::size_t per_part = intervals_per_part) noexcept;
/// The beginning of part `part` of `parts` among `count` items: a multiple of `unit`, or `count` if `part` is `parts`.
[[nodiscard]] std::size_t begin_of_part(std::size_t part, std::size_t parts, std::size_t count,
                                        std::size_t unit = 1) noexcept;

/// Refers to a function of the number of a part; allocates nothing.
class PartWork {
 public:
  /// The function is called in place: it must outlive this.
  template <class Function>
  // NOLINTNEXTLINE(google-explicit-constructor): made in the call of for_each_part.
  PartWork(const Function& function)
      : function_(&function),
        call_([](const void* object, std::size_t part) { (*static_cast<const Function*>(object))(part); }) {}

  /// Works on one part.
  void operator()(std::size_t part) const { call_(function_, part); }

 private:
  const void* function_;
  void (*call_)(const void*, std::size_t);
};

/// Calls `work(part)` for part from 0 to parts - 1 on `thread_count()` threads, in any order. Returns when all calls
/// have returned, or rethrows the first exception. If the threads are busy already (with a call from another thread, or
/// from inside `work`), the caller does all parts itself.
void for_each_part(std::size_t parts, const PartWork& work);

}  // namespace dmocbench
