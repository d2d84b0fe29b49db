#include "bench/summary/curves.hpp"

#include <algorithm>

namespace dmocbench {

std::vector<Curve> curves_of(const Table& table) {
  std::vector<Curve> curves;
  for (const Row& row : table.rows()) {
    Curve curve{row.text("problem"),
                row.text("method"),
                row.text("tableau"),
                row.text("stages"),
                row.text("solver"),
                row.text("derivatives"),
                {}};
    auto found = std::find_if(curves.begin(), curves.end(), [&](const Curve& known) {
      return known.label() == curve.label() && known.solver == curve.solver && known.derivatives == curve.derivatives;
    });
    if (found == curves.end()) found = curves.insert(curves.end(), std::move(curve));
    found->rows.push_back(&row);
  }
  return curves;
}

}  // namespace dmocbench
