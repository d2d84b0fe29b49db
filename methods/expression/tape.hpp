#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/expression/schedule.hpp"
#include "methods/expression/tape_kernel.hpp"
#include "methods/runtime/instruction_set.hpp"

namespace dmocbench {

/// A schedule made ready to be evaluated over all intervals of a grid.
///
/// The same straight-line code is carried out for a block of intervals at a time: every instruction is a loop over
/// `block_width` numbers that become vector instructions. Sums and products whose values have one reader are carried
/// out with it, in registers (`compound_steps`); the others live in slots that are reused as soon as a value is dead
/// (`ColumnPlan`), so that a block stays in the first-level cache. A tape is immutable: threads may share it, each with
/// a `Workspace` of its own.
class Tape {
 public:
  /// Intervals evaluated together.
  static constexpr std::size_t block_width = tape_block_width;

  /// Where an input's values are: entry k for interval k, or one value for all intervals.
  struct Input {
    const double* data = nullptr;
    bool same_for_all = false;
  };

  /// The memory of one evaluation: slots, constants and the table of columns. Not to be shared between threads.
  class Workspace {
   public:
    explicit Workspace(const Tape& tape);
    // The table of columns points into this workspace's own slots; a move keeps them where they are.
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;
    Workspace(Workspace&&) noexcept = default;
    Workspace& operator=(Workspace&&) noexcept = default;
    ~Workspace() = default;

   private:
    friend class Tape;
    // On a boundary of a cache line, which the widest registers are as long as: across one, loads and stores take
    // twice.
    struct alignas(64) Column {
      std::array<double, block_width> numbers{};
    };
    std::uint64_t serial_;  // of the tape
    std::vector<Column> slots_;
    std::vector<double*> columns_;
  };

  Tape() = default;
  explicit Tape(const Schedule& schedule, InstructionSet set = preferred_instruction_set());

  /// Evaluates intervals 0 .. count - 1, or from `begin` to `end` - 1.
  ///
  /// `inputs[i]` is read where the schedule reads input i, at the entries of these intervals only; inputs the schedule
  /// does not read may be null. `outputs[j]` receives their values, each at the entry of its interval. Outputs must not
  /// overlap inputs or each other. Allocates nothing. Throws `Error` if there are too few inputs or outputs or the
  /// workspace is another tape's.
  void evaluate(std::size_t count, std::span<const Input> inputs, std::span<double* const> outputs,
                Workspace& workspace) const {
    evaluate(0, count, inputs, outputs, workspace);
  }
  void evaluate(std::size_t begin, std::size_t end, std::span<const Input> inputs, std::span<double* const> outputs,
                Workspace& workspace) const;

  [[nodiscard]] std::size_t input_count() const noexcept { return input_count_; }
  [[nodiscard]] std::size_t output_count() const noexcept { return output_count_; }
  /// Instructions per interval that compute (copies of inputs or constants to outputs are not counted).
  [[nodiscard]] std::size_t operation_count() const noexcept { return operation_count_; }
  /// Columns of `block_width` numbers that intermediate values need.
  [[nodiscard]] std::size_t slot_count() const noexcept { return slot_count_; }
  [[nodiscard]] InstructionSet instruction_set() const noexcept { return set_; }

 private:
  struct ReadInput {
    std::uint32_t column;  // its place in the table of columns
    std::size_t index;     // its number among the inputs
  };

  void point_to_block(std::size_t first, std::span<const Input> inputs, std::span<double* const> outputs,
                      Workspace& workspace) const;

  // The table of columns: first the slots, then the constants, then the inputs that are read, then the outputs.
  std::vector<TapeInstruction> instructions_;
  std::vector<double> constants_;
  std::vector<ReadInput> read_inputs_;
  std::size_t slot_count_ = 0;
  std::size_t input_count_ = 0;
  std::size_t output_count_ = 0;
  std::size_t operation_count_ = 0;
  std::uint64_t serial_ = 0;  // tells tapes apart; a copy is the same tape
  InstructionSet set_ = InstructionSet::baseline;
};

}  // namespace dmocbench
