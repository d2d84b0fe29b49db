#include "methods/solvers/interior_point/kkt_choice.hpp"

#include <utility>

#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/kkt/refined_kkt.hpp"
#include "methods/kkt/sparse_kkt.hpp"

namespace dmocbench::interior_point {

tl::expected<std::unique_ptr<kkt::KktSystem>, std::string> make_kkt(NonlinearProgram& program,
                                                                    const InteriorPointOptions& choices) {
  if (choices.make_kkt_system) return choices.make_kkt_system(program);
  if (choices.factorisation == InteriorPointOptions::Factorisation::sparse) {
    return std::make_unique<kkt::SparseKkt>(program);
  }
  if (program.interval_structure() != nullptr && program.interval_structure()->has_interior_equations) {
    return std::make_unique<kkt::SparseKkt>(program, kkt::SparseKkt::Order::along_the_horizon);
  }
  return kkt::IntervalKkt::make(program).map(
      [&](auto by_intervals) { return std::make_unique<kkt::RefinedKkt>(program, std::move(by_intervals)); });
}

}  // namespace dmocbench::interior_point
