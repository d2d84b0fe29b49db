#include "bench/summary/ratios.hpp"

#include <array>
#include <optional>
#include <string>

#include "bench/experiment/solve_case.hpp"
#include "bench/summary/cost_at_error.hpp"
#include "bench/summary/curves.hpp"

namespace dmocbench {

namespace {

struct Currency {
  const char* name;
  const char* solver;
  const char* crash;
  const char* column;
};

constexpr std::array currencies{
    Currency{"free_variables", "sqp", "none", "free_variables"},
    Currency{"kkt_nonzeros", "sqp", "none", "kkt_nonzeros"},
    Currency{"factor_nonzeros", "sqp", "none", "factor_nonzeros"},
    Currency{"minor_iterations", "sqp", "none", "minor_iterations"},
    Currency{"minor_iterations_crash_basis", "sqp", "basis", "minor_iterations"},
    Currency{"sqp_major_iterations", "sqp", "none", "major_iterations"},
    Currency{"sqp_seconds", "sqp", "none", "seconds"},
    Currency{"sqp_seconds_crash_basis", "sqp", "basis", "seconds"},
    Currency{"ipopt_iterations", "ipopt", "", "major_iterations"},
    Currency{"ipopt_seconds", "ipopt", "", "seconds"},
    Currency{"slsqp_evaluations", "nlopt", "", "evaluations"},
    Currency{"slsqp_seconds", "nlopt", "", "seconds"},
};

/// The part of a curve that a currency is about.
std::vector<const Row*> rows_of(const Curve& curve, const Currency& currency) {
  std::vector<const Row*> rows;
  for (const Row* row : curve.rows) {
    if (is_usable(*row) && row->text("crash") == currency.crash) rows.push_back(row);
  }
  return rows;
}

std::optional<double> on_same_grid(const std::vector<const Row*>& rows, const Row& other, const char* column) {
  for (const Row* row : rows) {
    if (row->text("intervals") == other.text("intervals")) return row->number(column);
  }
  return std::nullopt;
}

std::optional<double> at_same_error(const std::vector<const Row*>& rows, const Row& other, const char* column) {
  const auto error = other.number("replay_error");
  if (!error) return std::nullopt;
  return cost_at_error(error_cost_points(rows, "replay_error", column), *error);
}

std::optional<double> ratio(std::optional<double> a, std::optional<double> b) {
  if (!a || !b || *b <= 0.0) return std::nullopt;
  return *a / *b;
}

void append(const Curve& dmoc, const Curve& collocation, const Currency& currency, Table& table) {
  const std::vector<const Row*> of_dmoc = rows_of(dmoc, currency);
  for (const Row* row : rows_of(collocation, currency)) {
    Row result;
    for (const char* key : {"problem", "method", "tableau", "stages", "intervals"}) result.set(key, row->text(key));
    result.set("currency", std::string(currency.name));
    const auto cost = row->number(currency.column);
    result.set("ratio_at_equal_intervals", ratio(cost, on_same_grid(of_dmoc, *row, currency.column)));
    result.set("ratio_at_equal_accuracy", ratio(cost, at_same_error(of_dmoc, *row, currency.column)));
    table.append(std::move(result));
  }
}

}  // namespace

Table currency_ratios(const Table& iterations) {
  Table table({"problem", "method", "tableau", "stages", "intervals", "currency", "ratio_at_equal_intervals",
               "ratio_at_equal_accuracy"});
  const std::vector<Curve> curves = curves_of(iterations);
  for (const Curve& dmoc : curves) {
    if (dmoc.method != "dmoc") continue;
    for (const Curve& collocation : curves) {
      const bool comparable = collocation.method != "dmoc" && collocation.problem == dmoc.problem &&
                              collocation.tableau == dmoc.tableau && collocation.stages == dmoc.stages &&
                              collocation.solver == dmoc.solver;
      if (!comparable) continue;
      for (const Currency& currency : currencies) {
        if (dmoc.solver == currency.solver) append(dmoc, collocation, currency, table);
      }
    }
  }
  return table;
}

}  // namespace dmocbench
