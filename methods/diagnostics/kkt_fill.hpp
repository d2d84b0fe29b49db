#pragma once

#include <cstddef>

#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// Entries of the matrix (H, Aᵀ; A, 0) that every Newton-like method for the program factorises, in the free variables
/// and the constraints: the lower triangle with its whole diagonal.
struct KktFill {
  std::size_t nonzeros = 0;  ///< entries of the matrix
  /// Entries of its Cholesky factor by a symbolic analysis (approximate minimum degree), the same for all methods: the
  /// storage of a sparse direct solver without pivoting.
  std::size_t factor_nonzeros = 0;
};

/// The fill of the program's KKT matrix at its structure alone.
[[nodiscard]] KktFill kkt_fill(const Transcription& transcription);

}  // namespace dmocbench
