#include "bench/extensions/primitives/trim_library.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace dmocbench {

PrimitiveLibrary library_of_trims(const Problem& problem, const std::vector<Trim>& trims, double step,
                                  int intervals_per_step) {
  PrimitiveLibrary library = PrimitiveLibrary::of(problem, step, intervals_per_step);
  for (const Trim& trim : trims) library.states.push_back(trim.state);
  return library;
}

void solve_cheapest(const Problem& problem, const std::vector<PrimitiveRequest>& requests, std::size_t most,
                    PrimitiveLibrary& library, const PrimitiveOptions& options) {
  solve_primitives(problem, requests, library, options);
  std::vector<Primitive>& all = library.primitives;
  std::ranges::stable_sort(all, {}, &Primitive::cost);
  std::map<std::tuple<std::size_t, std::size_t, int, long long, long long>, std::size_t> kept;
  std::erase_if(all, [&](const Primitive& each) {
    const Eigen::MatrixXd& turn = each.displacement.linear;
    const auto key = std::tuple(each.first, each.last, each.duration, std::llround(4.0 * turn(0, 0)),
                                turn.rows() > 1 ? std::llround(4.0 * turn(1, 0)) : 0);
    return ++kept[key] > most;
  });
}

}  // namespace dmocbench
