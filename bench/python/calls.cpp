#include "bench/python/calls.hpp"

#include <chrono>

namespace dmocbench::python {

namespace py = pybind11;

namespace {

Call*& innermost() {
  thread_local Call* call = nullptr;
  return call;
}

long long milliseconds() {
  using namespace std::chrono;
  return duration_cast<std::chrono::milliseconds>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Call::Call() : outer_(std::exchange(innermost(), this)) {}

Call::~Call() { innermost() = outer_; }

void Call::keep(py::error_already_set& error) {
  Call* const call = innermost();
  if (call != nullptr && !call->kept_) call->kept_ = std::make_unique<py::error_already_set>(error);
}

void Call::raise_kept() {
  if (!kept_) return;
  const auto kept = std::move(kept_);
  kept->restore();
  throw py::error_already_set();
}

bool Call::is_interrupted() {
  constexpr long long pause = 20;
  if (is_interrupted_ || milliseconds() < last_asked_ + pause) return is_interrupted_;
  last_asked_ = milliseconds();
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() == 0) return false;
  py::error_already_set error;
  kept_ = std::make_unique<py::error_already_set>(error);
  is_interrupted_ = true;
  return true;
}

}  // namespace dmocbench::python
