#pragma once

#include <cstddef>

#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// Entries of the matrix (H, Aᵀ; A, 0) that every Newton-like method for the program factorises: free variables and
/// rows, lower triangle with its whole diagonal.
struct KktFill {
  std::size_t nonzeros = 0;
  /// Of its Cholesky factor by one symbolic analysis (approximate minimum degree), the same for all methods: what a
  /// sparse direct solver without pivoting would have to store.
  std::size_t factor_nonzeros = 0;
};

[[nodiscard]] KktFill kkt_fill(const Transcription& transcription);

}  // namespace dmocbench
