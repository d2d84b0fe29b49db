#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "methods/expression/schedule.hpp"

namespace dmocbench {

/// The readers of a defined variable. AMPL numbers the shared ones first, then the rows', then the objective's.
enum class AmplReaders : std::uint8_t { rows_and_objective, rows, objective };
/// The number of kinds.
inline constexpr std::size_t ampl_reader_kinds = 3;

/// The number of defined variables for each kind of readers.
using AmplCounts = std::array<std::size_t, ampl_reader_kinds>;

/// The text of formulas in AMPL's format (Gay, "Writing .nl files"): a line per operation, operand or number, operands
/// after their operation.
///
/// The value of a step that several steps or outputs read becomes a defined variable, all others stand where they are
/// read. The text is therefore as long as the straight-line code, however much is shared.
class AmplDefinitions {
 public:
  /// `next`: the numbers that the next defined variables of each kind get.
  explicit AmplDefinitions(AmplCounts next) : next_(next) {}

  /// Adds the definitions that a schedule needs. Its output 0 belongs to the objective, the others to rows; input i is
  /// the variable `variables[i]`. Returns the text of every output, without the last end of a line. Throws `Error` at
  /// an operation that AMPL lacks.
  [[nodiscard]] std::vector<std::string> add(const Schedule& schedule, const std::vector<std::size_t>& variables);

  /// The definitions (V segments) so far, in the order of their numbers.
  [[nodiscard]] std::string text() const { return texts_[0] + texts_[1] + texts_[2]; }

  /// The numbers of defined variables that a schedule adds, by their readers.
  [[nodiscard]] static AmplCounts count(const Schedule& schedule);

 private:
  AmplCounts next_;
  std::array<std::string, ampl_reader_kinds> texts_;
};

}  // namespace dmocbench
