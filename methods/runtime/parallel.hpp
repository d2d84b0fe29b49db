#pragma once

#include <cstddef>

namespace dmocbench {

/// How many threads work on one program where that pays: what `set_thread_count` said last, else the environment
/// variable DMOCBENCH_THREADS, else one per processor. Throws `Error` if the variable is not a number from 1 to 1024.
[[nodiscard]] std::size_t thread_count();
/// Throws `Error` unless 1 <= count <= 1024.
void set_thread_count(std::size_t count);

/// Fewer intervals than this are one part: a tape takes 25 to 65 µs for them and a sweep of the interior-point method
/// some 200 µs (measured), which should be well above what it takes to wake another thread (not measured).
inline constexpr std::size_t intervals_per_part = 4096;
/// More parts than this there never are.
inline constexpr std::size_t most_parts = 64;
/// Parts that a number of intervals is cut into. It does not depend on the number of threads, so that no result does.
[[nodiscard]] std::size_t part_count(std::size_t intervals, std::size_t per_part = intervals_per_part) noexcept;
/// Where part `part` of `parts` begins among `count` things; a multiple of `unit`, but for the end.
[[nodiscard]] std::size_t begin_of_part(std::size_t part, std::size_t parts, std::size_t count,
                                        std::size_t unit = 1) noexcept;

/// Something that can be called with the number of a part; refers to it, and allocates nothing.
class PartWork {
 public:
  template <class Function>
  // NOLINTNEXTLINE(google-explicit-constructor): made in the call of for_each_part.
  PartWork(const Function& function)
      : function_(&function),
        call_([](const void* object, std::size_t part) { (*static_cast<const Function*>(object))(part); }) {}

  void operator()(std::size_t part) const { call_(function_, part); }

 private:
  const void* function_;
  void (*call_)(const void*, std::size_t);
};

/// Calls `work(part)` for part = 0 .. parts - 1, by as many threads as there are, in no order, and returns when all
/// have returned; then throws what the first that threw has thrown. Where the threads are in use already (by another
/// thread of the caller's, or from inside `work`) the caller does all by itself.
void for_each_part(std::size_t parts, const PartWork& work);

}  // namespace dmocbench
