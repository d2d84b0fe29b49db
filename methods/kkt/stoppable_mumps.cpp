// Functions that MUMPS calls, and its own, in place of the libraries' functions, as the dynamic linker looks into the
// program first: a failure or a long computation inside MUMPS ends as an exception, which passes through it, and
// through Ipopt where that called it, as one of `new` would. Work arrays of the call are lost.
#include <cstddef>
#include <new>
#include <utility>

#include <dlfcn.h>
#include <dmumps_c.h>

#include "methods/runtime/stop_scope.hpp"

extern "C" {

/// Called where an allocation fails that MUMPS does not report; its own ends the process with exit code 0.
void mumps_abort_();  // NOLINT(readability-identifier-naming)
void mumps_abort_() { throw std::bad_alloc(); }
}

namespace {

/// The library's function with that name, which ours replaces.
template <class Function>
Function* of_library(const char* name, void* where = RTLD_NEXT) {
  return reinterpret_cast<Function*>(dlsym(where, name));  // NOLINT(*-reinterpret-cast): dlsym returns void*
}

/// Whether MUMPS factorises in this thread.
thread_local bool is_factorising = false;

/// Frees the memory of MUMPS' load counter after an interrupted factorisation: it would reject the next one.
void free_loads() {
  using End = void(int* info, int* slaves, int* error);
  static auto* const end = of_library<End>("__dmumps_load_MOD_dmumps_load_end", RTLD_DEFAULT);
  int info = 0;
  int slaves = 1;
  int error = 0;
  if (end != nullptr) end(&info, &slaves, &error);
}

bool factorises(int job) { return job == 2 || job >= 4; }

}  // namespace

extern "C" {

/// MUMPS, which can be stopped while it factorises.
void dmumps_c(DMUMPS_STRUC_C* data) {
  static auto* const call = of_library<decltype(dmumps_c)>("dmumps_c");
  const bool was_factorising = std::exchange(is_factorising, factorises(data->job));
  try {
    call(data);
  } catch (const dmocbench::Stopped&) {
    free_loads();
    is_factorising = was_factorising;
    throw;
  } catch (...) {
    is_factorising = was_factorising;
    throw;
  }
  is_factorising = was_factorising;
}

/// The product of matrices of BLAS, C = α A B + β C. Where pivots fail, one factorisation takes minutes; this is the
/// function that MUMPS calls most often in it, some hundredths of a second apart, so stop requests are checked here.
void dgemm_(const char* of_a, const char* of_b, const int* m, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
            const int* ldc, std::size_t length_a, std::size_t length_b);  // NOLINT(readability-identifier-naming)
void dgemm_(const char* of_a, const char* of_b, const int* m, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
            const int* ldc, std::size_t length_a, std::size_t length_b) {
  static auto* const multiply = of_library<decltype(dgemm_)>("dgemm_");
  constexpr double worth_asking = 1e5;  // products, which take ten times as long as the check
  if (is_factorising && 1.0 * *m * *n * *k > worth_asking) dmocbench::stop_if_requested();
  multiply(of_a, of_b, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc, length_a, length_b);
}
}
