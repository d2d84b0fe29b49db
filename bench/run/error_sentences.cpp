#include "bench/run/error_sentences.hpp"

#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "bench/run/interrupt.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// True for the error of std::thread when the system has no more threads.
bool is_out_of_threads(const std::exception& error) noexcept {
  const auto* const of_system = dynamic_cast<const std::system_error*>(&error);
  return of_system != nullptr && of_system->code() == std::errc::resource_unavailable_try_again;
}

}  // namespace

// An array of Eigen, a vector, or the heap itself.
bool is_out_of_memory(const std::exception& error) noexcept {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
         dynamic_cast<const std::length_error*>(&error) != nullptr;
}

std::string sentence_of(const std::exception& error) {
  if (is_out_of_memory(error)) return "out of memory; use fewer intervals or raise the limit (ulimit -v)";
  if (is_out_of_threads(error)) {
    return "the system cannot create more threads; set DMOCBENCH_THREADS=1 or raise the limits (ulimit -u, -v)";
  }
  if (const auto* const of_file = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
    return fmt::format("{}: {}", of_file->path1().string(), of_file->code().message());
  }
  const bool is_ours = dynamic_cast<const Error*>(&error) != nullptr ||
                       dynamic_cast<const Interrupted*>(&error) != nullptr ||
                       dynamic_cast<const std::system_error*>(&error) != nullptr;  // the system's words
  return is_ours ? error.what() : fmt::format("internal error, please report it: {}", error.what());
}

}  // namespace dmocbench
