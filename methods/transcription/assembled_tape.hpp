#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "methods/expression/tape.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/column_assembly.hpp"

namespace dmocbench {

/// A tape whose outputs are parts of one long array: output e stands at places[e], see `ColumnAssembly`.
class AssembledTape {
 public:
  /// `size` is the length of the array, `intervals` the number of intervals. Throws `Error` if there is not one place
  /// per output.
  AssembledTape(const Schedule& schedule, const std::vector<ColumnPlace>& places, std::size_t size,
                std::size_t intervals, AssemblyMode mode = AssemblyMode::whole);

  /// Writes all `size` entries of `result`, or adds to them. Allocates nothing; long grids by several threads
  /// (parallel.hpp), with the same result.
  void evaluate(std::span<const Tape::Input> inputs, VectorOut result);

  [[nodiscard]] const Tape& tape() const noexcept { return tape_; }

 private:
  Tape tape_;
  std::vector<Tape::Workspace> workspaces_;  // one per part
  ColumnAssembly assembly_;
};

}  // namespace dmocbench
