#pragma once

#include <memory>
#include <utility>

#include <pybind11/pybind11.h>

#include "methods/error.hpp"

namespace dmocbench::python {

/// A call from Python into C++. While it exists, an exception by which a function of a Python problem fails is kept, so
/// that Python sees it again with its traceback, and not only the sentence that C++ makes of it.
class Call {
 public:
  Call();
  ~Call();
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  /// Keeps an exception for the innermost call of this thread; the first one counts. Holds the GIL.
  static void keep(pybind11::error_already_set& error);
  /// Raises the kept exception, if there is one. Holds the GIL.
  void raise_kept();

  /// Whether the user has pressed Ctrl-C since: looks it up in Python, which answers in its main thread only, at most
  /// fifty times a second. For callers without the GIL.
  [[nodiscard]] bool is_interrupted();
  /// The kept exception will be raised, even if C++ has converted it.
  void raise_later() noexcept { is_to_be_raised_ = true; }
  /// Whether it is.
  [[nodiscard]] bool is_to_be_raised() const noexcept { return is_to_be_raised_ || is_interrupted_; }

 private:
  std::unique_ptr<pybind11::error_already_set> kept_;
  long long last_asked_ = 0;  // ms
  bool is_interrupted_ = false;
  bool is_to_be_raised_ = false;
  Call* outer_;
};

/// `work(call)` without the GIL, so that other threads of Python run meanwhile. An exception of a Python problem is
/// raised again, and so is Ctrl-C.
template <class Work>
auto without_gil(const Work& work) {
  Call call;
  try {
    const auto working = [&] {
      const pybind11::gil_scoped_release release;
      return work(call);
    };
    auto result = working();
    if (call.is_to_be_raised()) call.raise_kept();
    return result;
  } catch (const Error&) {  // the GIL is back
    call.raise_kept();
    throw;
  }
}

}  // namespace dmocbench::python
