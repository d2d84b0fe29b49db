#pragma once

#include <string>

#include <Eigen/Core>

#include "bench/experiment/column.hpp"
#include "methods/diagnostics/convergence_order.hpp"

namespace dmocbench {

/// What a row is about where nothing is solved.
struct Scheme {
  std::string problem;
  std::string method;
  std::string tableau;
  Eigen::Index stages = 0;
};

/// The columns that tell `Record::scheme`.
template <class Record>
[[nodiscard]] Columns<Record> scheme_columns() {
  constexpr auto scheme = &Record::scheme;
  return {{"problem", "", "name of the problem", from(scheme, &Scheme::problem)},
          {"method", "", "family of elements, or another integrator", from(scheme, &Scheme::method)},
          {"tableau", "", "family of Butcher tableaus", from(scheme, &Scheme::tableau)},
          {"stages", "", "number of stages s", from(scheme, &Scheme::stages)}};
}

/// The columns that tell a fitted order.
template <class Record>
[[nodiscard]] Columns<Record> fitted_order_columns(FittedOrder Record::*fit) {
  return {{"slope", "", "fitted order", from(fit, &FittedOrder::order)},
          {"standard_error", "", "of the order; empty with two points",
           [fit](const Record& record) {
             const FittedOrder& order = record.*fit;
             return order.points > 2 ? Cell(order.standard_error) : Cell();
           }},
          {"finest", "", "smallest step used", from(fit, &FittedOrder::finest)},
          {"coarsest", "", "largest step used", from(fit, &FittedOrder::coarsest)},
          {"points", "", "number of steps used", from(fit, &FittedOrder::points)}};
}

}  // namespace dmocbench
