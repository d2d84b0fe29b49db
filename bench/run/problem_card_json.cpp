#include "bench/run/problem_card_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "bench/run/embedded_file.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "problems/problem_registry.hpp"

DMOCBENCH_EMBEDDED_FILE(problems_schema, "bench/run/problems.schema.json");

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json values(const Eigen::VectorXd& vector) {
  Json list = Json::array();
  for (const double value : vector) list.push_back(finite(value));
  return list;
}

Json interval(double lower, double upper) { return {{"lower", finite(lower)}, {"upper", finite(upper)}}; }

/// One entry per quantity; no entries if there are no bounds.
Json bounds_of(const Bounds& bounds) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < bounds.lower.size(); ++i) list.push_back(interval(bounds.lower[i], bounds.upper[i]));
  return list;
}

Json end(const BoundaryState& state, const EndBounds& bounds) {
  return {{"q", values(state.q)},
          {"v", values(state.v)},
          {"q_bounds", bounds_of(bounds.q)},
          {"v_bounds", bounds_of(bounds.v)}};
}

Json parameters(const Problem& problem) {
  Json list = Json::array();
  for (const Parameter& parameter : problem.parameters()) {
    list.push_back({{"name", parameter.name},
                    {"value", parameter.value},
                    {"unit", parameter.unit},
                    {"meaning", parameter.meaning},
                    {"lower", finite(parameter.lower)},
                    {"upper", finite(parameter.upper)},
                    {"whole", parameter.whole},
                    {"unknown", parameter.is_unknown}});
  }
  return list;
}

Json optimum(const std::optional<ReferenceOptimum>& reference) {
  if (!reference) return nullptr;
  Json published = Json::array();
  for (const PublishedOptimum& value : reference->published) {
    published.push_back({{"cost", value.objective}, {"source", value.source}});
  }
  return {{"cost", reference->objective},
          {"digits", reference->digits},
          {"routes", reference->certificate},
          {"published", published},
          {"remark", reference->remark}};
}

}  // namespace

nlohmann::ordered_json problem_card_json(const Problem& problem) {
  const ProblemCard card = problem.card();
  const ProblemBounds bounds = problem.bounds();
  const TracedProblem traced(problem);
  const std::string& library = known_problems().origin(problem.name());
  return {{"name", problem.name()},
          {"description", card.description},
          {"source", card.source},
          {"library", library.empty() ? "dmocbench" : library},
          {"configurations", problem.configuration_names()},
          {"controls", problem.control_names()},
          {"first_order_states", problem.first_order_names()},
          {"configuration_units", card.configuration_units},
          {"control_units", card.control_units},
          {"parameters", parameters(problem)},
          {"time_unit", {{"name", card.time_unit.name}, {"factor", card.time_unit.factor}}},
          {"horizon",
           {{"lower", bounds.horizon.lower}, {"upper", finite(bounds.horizon.upper)}, {"guess", problem.horizon()}}},
          {"start", end(problem.initial_state(), bounds.first)},
          {"end", end(problem.final_state(), bounds.last)},
          {"bounds", {{"q", bounds_of(bounds.q)}, {"v", bounds_of(bounds.v)}, {"u", bounds_of(bounds.u)}}},
          {"holonomic_constraints", traced.holonomic_count()},
          {"velocity_constraints", traced.velocity_constraint_count()},
          {"path_constraints", traced.path_constraint_count()},
          {"boundary_conditions", traced.boundary_condition_count()},
          {"integral_constraints", traced.integral_count()},
          {"guess", card.guess},
          {"cost_scale", problem.cost_scale()},
          {"optimum", optimum(card.reference)}};
}

std::string_view problem_cards_schema() noexcept { return dmocbench_file_problems_schema; }

}  // namespace dmocbench
