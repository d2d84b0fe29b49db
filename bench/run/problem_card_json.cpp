#include "bench/run/problem_card_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "methods/mechanics/traced_problem.hpp"
#include "problems/problem_registry.hpp"

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

// Schemas.

Json text() { return {{"type", "string"}}; }
Json number() { return {{"type", "number"}}; }
Json number_or_null() { return {{"type", {"number", "null"}}}; }
Json count() { return {{"type", "integer"}, {"minimum", 0}}; }
Json list_of(const Json& items) { return {{"type", "array"}, {"items", items}}; }

/// All properties are required, others are not allowed.
Json object_of(const Json& properties, const std::string& description = "") {
  Json names = Json::array();
  for (const auto& [name, schema] : properties.items()) names.push_back(name);
  Json schema{{"type", "object"}, {"properties", properties}, {"required", names}, {"additionalProperties", false}};
  if (!description.empty()) schema["description"] = description;
  return schema;
}

Json described(Json schema, const char* description) {
  schema["description"] = description;
  return schema;
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
          {"path_constraints", traced.path_constraint_count()},
          {"boundary_conditions", traced.boundary_condition_count()},
          {"integral_constraints", traced.integral_count()},
          {"guess", card.guess},
          {"cost_scale", problem.cost_scale()},
          {"optimum", optimum(card.reference)}};
}

nlohmann::ordered_json problem_cards_schema() {
  const Json bounds = list_of(object_of({{"lower", number_or_null()}, {"upper", number_or_null()}}));
  const Json state = object_of({{"q", list_of(number())},
                                {"v", list_of(number())},
                                {"q_bounds", described(bounds, "equal ones prescribe the state")},
                                {"v_bounds", bounds}},
                               "a state; where its bounds leave it free, the guess takes it");
  const Json parameter = object_of({{"name", text()},
                                    {"value", number()},
                                    {"unit", text()},
                                    {"meaning", text()},
                                    {"lower", number_or_null()},
                                    {"upper", number_or_null()},
                                    {"whole", {{"type", "boolean"}}},
                                    {"unknown", described({{"type", "boolean"}}, "a solve chooses it")}});
  Json optimum = object_of({{"cost", described(number(), "the least cost")},
                            {"digits", described(count(), "significant digits of it that are certain")},
                            {"routes", described(text(), "closed form, or which independent routes agree to them")},
                            {"published", list_of(object_of({{"cost", number()}, {"source", text()}}))},
                            {"remark", text()}},
                           "null where it is not known for these parameters");
  optimum["type"] = {"object", "null"};
  const Json card = object_of(
      {{"name", text()},
       {"description", text()},
       {"source", text()},
       {"library", described(text(), "where the problem comes from: dmocbench, or the path of a library")},
       {"configurations", described(list_of(text()), "q_1 .. q_n")},
       {"controls", described(list_of(text()), "u_1 .. u_m")},
       {"first_order_states", described(list_of(text()), "y_1 .. y_l")},
       {"configuration_units", described(list_of(text()), "of q_1 .. q_n; empty if not stated")},
       {"control_units", described(list_of(text()), "of u_1 .. u_m; empty if not stated")},
       {"parameters", list_of(parameter)},
       {"time_unit", described(object_of({{"name", text()}, {"factor", number()}}),
                               "size of one unit of the problem's time in this unit")},
       {"horizon", described(object_of({{"lower", number()}, {"upper", number_or_null()}, {"guess", number()}}),
                             "T; fixed where its bounds are equal")},
       {"start", state},
       {"end", state},
       {"bounds", described(object_of({{"q", bounds}, {"v", bounds}, {"u", bounds}}),
                            "along the motion, an entry per quantity; empty if there are no bounds")},
       {"holonomic_constraints", described(count(), "how many constraints g(q) = 0")},
       {"path_constraints", described(count(), "how many")},
       {"boundary_conditions", described(count(), "how many")},
       {"integral_constraints", described(count(), "how many")},
       {"guess", text()},
       {"cost_scale", described(number(), "the factor by which solvers see the cost")},
       {"optimum", optimum}},
      "a problem, in the units in which it is solved");
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"title", "problem cards"},
          {"type", "object"},
          {"properties", {{"dmocbench", text()}, {"problems", list_of(card)}}},
          {"required", {"dmocbench", "problems"}},
          {"additionalProperties", false}};
}

}  // namespace dmocbench
