#include "methods/judgement/kkt_of_conditions.hpp"

#include <utility>

#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/kkt/sparse_kkt.hpp"

namespace dmocbench {

std::unique_ptr<kkt::KktSystem> kkt_system_of(const NonlinearProgram& program) {
  if (auto by_intervals = kkt::IntervalKkt::make(program)) return std::move(*by_intervals);
  return kkt_system_of_any_point(program);
}

std::unique_ptr<kkt::KktSystem> kkt_system_of_any_point(const NonlinearProgram& program) {
  return std::make_unique<kkt::SparseKkt>(program, kkt::SparseKkt::Order::found, kkt::SparseKkt::Inertia::any);
}

}  // namespace dmocbench
