#include "methods/transcription/assembled_tape.hpp"

#include "methods/error.hpp"
#include "methods/runtime/parallel.hpp"

namespace dmocbench {

AssembledTape::AssembledTape(const Schedule& schedule, const std::vector<ColumnPlace>& places, std::size_t size,
                             std::size_t intervals, AssemblyMode mode)
    : tape_(schedule), assembly_(places, size, intervals, mode) {
  if (places.size() != tape_.output_count()) throw Error("an assembled tape needs one place per output");
  const std::size_t parts = part_count(intervals);
  workspaces_.reserve(parts);
  for (std::size_t part = 0; part < parts; ++part) workspaces_.emplace_back(tape_);
}

void AssembledTape::evaluate(std::span<const Tape::Input> inputs, VectorOut result) {
  const auto columns = assembly_.open(result);
  const std::size_t parts = workspaces_.size();
  const std::size_t intervals = assembly_.intervals();
  for_each_part(parts, [&](std::size_t part) {
    tape_.evaluate(begin_of_part(part, parts, intervals, Tape::block_width),
                   begin_of_part(part + 1, parts, intervals, Tape::block_width), inputs, columns, workspaces_[part]);
  });
  assembly_.close(result);
}

}  // namespace dmocbench
