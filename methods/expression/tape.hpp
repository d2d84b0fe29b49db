#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "methods/expression/schedule.hpp"
#include "methods/expression/tape_kernel.hpp"
#include "methods/runtime/instruction_set.hpp"

namespace dmocbench {

/// The steps of a schedule that one instruction carries out.
struct CompoundStep {
  std::size_t code = 0;                                 ///< the `instruction_code`
  std::uint32_t step = 0;                               ///< the step whose value is the result
  std::optional<std::uint32_t> cosine;                  ///< the cosine of the same number, if `step` is a sine
  std::array<std::uint32_t, most_operands> operands{};  ///< steps whose values are read
  std::size_t operand_count = 0;                        ///< how many of them there are
};

/// The computing steps, grouped into as few compounds as possible, in an order in which they can be carried out: a sum,
/// difference or product whose only reader is of the same kind is carried out together with it. Values stay the same
/// bit by bit, except that sine and cosine of one number are computed together.
[[nodiscard]] std::vector<CompoundStep> compound_steps(const Schedule& schedule);

struct CompoundStep;

/// A schedule compiled for evaluation over all intervals of a grid.
///
/// The code is straight-line and runs on a block of intervals at a time: every instruction is a loop over `block_width`
/// numbers, which becomes vector instructions. A sum or product with a single reader is computed together with that
/// reader, in registers (`compound_steps`). All other values live in slots, which are reused as soon as a value is
/// dead, so that a block stays in the first-level cache. A tape is immutable: threads may share it, each with its own
/// `Workspace`.
class Tape {
 public:
  /// Intervals evaluated together.
  static constexpr std::size_t block_width = tape_block_width;

  /// The values of an input: entry k for interval k, or one value for all intervals.
  struct Input {
    const double* data = nullptr;  ///< a number per interval, or one for all
    bool same_for_all = false;     ///< true for one number that all intervals share
  };

  /// The memory of one evaluation: slots, constants and the table of series. Not to be shared between threads.
  class Workspace {
   public:
    /// A workspace for this tape; it may be used for any number of evaluations, by one thread at a time.
    explicit Workspace(const Tape& tape);
    // The table of series points into this workspace's own memory, which stays in place when it is moved.
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;
    Workspace(Workspace&&) noexcept = default;             ///< takes the memory of the other
    Workspace& operator=(Workspace&&) noexcept = default;  ///< takes the memory of the other
    ~Workspace() = default;

   private:
    friend class Tape;
    // Aligned to cache lines, which are as long as the widest registers: a load or store across two lines takes twice
    // as long.
    struct alignas(64) Series {
      std::array<double, block_width> numbers;
    };
    std::uint64_t serial_;  // of the tape
    // Not cleared. Of constants, inputs that are the same for all intervals, and slots.
    std::unique_ptr<Series[]> memory_;  // NOLINT(*-avoid-c-arrays)
    std::vector<double*> series_;
  };

  Tape() = default;
  /// Makes a schedule ready to be evaluated with the instructions of this set.
  explicit Tape(const Schedule& schedule, InstructionSet set = preferred_instruction_set());

  /// Evaluates intervals 0 to count - 1, or from `begin` to `end` - 1.
  ///
  /// `inputs[i]` holds the values of input i and is read at the entries of these intervals only; inputs that the
  /// schedule does not read may be null. `outputs[j]` receives the values of output j, each at the entry of its
  /// interval. Outputs must not overlap inputs or each other. Allocates nothing. Throws `Error` if there are too few
  /// inputs or outputs, or if the workspace belongs to another tape.
  void evaluate(std::size_t count, std::span<const Input> inputs, std::span<double* const> outputs,
                Workspace& workspace) const {
    evaluate(0, count, inputs, outputs, workspace);
  }
  /// Evaluates intervals `begin` to `end` - 1: output j of interval k goes to `outputs`[j][k].
  void evaluate(std::size_t begin, std::size_t end, std::span<const Input> inputs, std::span<double* const> outputs,
                Workspace& workspace) const;

  /// All outputs of intervals 0 to count - 1, a column each. Allocates its own workspace; throws likewise.
  [[nodiscard]] Eigen::MatrixXd table(Eigen::Index count, std::span<const Input> inputs) const;

  /// Inputs that the formulas may read.
  [[nodiscard]] std::size_t input_count() const noexcept { return input_count_; }
  /// Outputs per interval.
  [[nodiscard]] std::size_t output_count() const noexcept { return output_count_; }
  /// Instructions per interval that compute (copies of inputs or constants to outputs are not counted).
  [[nodiscard]] std::size_t operation_count() const noexcept { return operation_count_; }
  /// The number of slots, of `block_width` numbers each, for intermediate values.
  [[nodiscard]] std::size_t slot_count() const noexcept { return slot_count_; }
  /// The set whose instructions it uses.
  [[nodiscard]] InstructionSet instruction_set() const noexcept { return set_; }

 private:
  struct ReadInput {
    std::uint32_t position;  // in the table of series
    std::size_t index;       // its number among the inputs
  };

  /// The position of every step's value in the table of series, unless the value stays within a compound.
  [[nodiscard]] std::vector<std::uint32_t> place_values(const Schedule& schedule,
                                                        const std::vector<CompoundStep>& compounds);
  [[nodiscard]] std::uint32_t first_output() const noexcept {
    return static_cast<std::uint32_t>(constants_.size() + read_inputs_.size());
  }
  [[nodiscard]] std::size_t series_count() const noexcept { return first_output() + output_count_ + slot_count_; }
  void point_to_block(std::size_t first, std::span<const Input> inputs, std::span<double* const> outputs,
                      Workspace& workspace) const;

  // The table of series holds first the constants, then the inputs that are read, the outputs, and the slots.
  std::vector<TapeInstruction> instructions_;
  std::vector<double> constants_;
  std::vector<ReadInput> read_inputs_;
  std::size_t slot_count_ = 0;
  std::size_t input_count_ = 0;
  std::size_t output_count_ = 0;
  std::size_t operation_count_ = 0;
  std::uint64_t serial_ = 0;  // distinguishes tapes; a copy is the same tape
  InstructionSet set_ = InstructionSet::baseline;
};

}  // namespace dmocbench
