#include "methods/transcription/assembled_tape.hpp"

#include "methods/error.hpp"

namespace dmocbench {

AssembledTape::AssembledTape(const Schedule& schedule, const std::vector<ColumnPlace>& places, std::size_t size,
                             std::size_t intervals, AssemblyMode mode)
    : tape_(schedule), workspace_(tape_), assembly_(places, size, intervals, mode) {
  if (places.size() != tape_.output_count()) throw Error("an assembled tape needs one place per output");
}

void AssembledTape::evaluate(std::span<const Tape::Input> inputs, VectorOut result) {
  tape_.evaluate(assembly_.intervals(), inputs, assembly_.open(result), workspace_);
  assembly_.close(result);
}

}  // namespace dmocbench
