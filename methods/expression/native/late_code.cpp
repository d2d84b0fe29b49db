#include "methods/expression/native/late_code.hpp"

#include <utility>

#include "methods/expression/native/native_plan.hpp"

namespace dmocbench {

LateCode::LateCode(Schedule schedule, TapeSeries series, InstructionSet set, std::uint64_t intervals)
    : source_(std::make_unique<Source>(Source{std::move(schedule), std::move(series), set})), worthwhile_(intervals) {
  if (intervals == 0) make();
}

const NativeCode* LateCode::get_for(std::size_t intervals) {
  if (const NativeCode* code = get()) return code;
  const std::uint64_t before = evaluated_.fetch_add(intervals, std::memory_order_relaxed);
  const bool is_time = before < worthwhile_ && before + intervals >= worthwhile_;  // true once, for one thread
  if (is_time) make();
  return get();
}

void LateCode::make() {
  code_ = make_native_code(native_plan(source_->schedule, source_->series), source_->set);
  source_.reset();
  ready_.store(code_.get(), std::memory_order_release);
}

std::shared_ptr<LateCode> late_code_for(const Schedule& schedule, TapeSeries series, InstructionSet set,
                                        NativeCodeUse use) {
  const std::size_t operations = schedule.operation_count();
  if (use == NativeCodeUse::never || !has_native_code(set)) return nullptr;
  if (operations == 0 || operations > LateCode::most_operations) return nullptr;
  return std::make_shared<LateCode>(schedule, std::move(series), set,
                                    use == NativeCodeUse::always ? 0 : LateCode::worthwhile_intervals(operations));
}

}  // namespace dmocbench
