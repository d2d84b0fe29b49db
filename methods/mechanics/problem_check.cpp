#include "methods/mechanics/problem_check.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/expression/vectors.hpp"
#include "methods/mechanics/column_names.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/point_of_inputs.hpp"
#include "methods/mechanics/problem_bounds.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

/// Throws `Error` if a text of `owner`, such as "card().source", would leave its line or be obeyed by a terminal.
void require_one_line(const Problem& problem, std::string_view owner, std::string_view text) {
  if (!has_control_character(text)) return;
  throw Error("{}: {} has a line break or another control character; write it on one line", problem.name(), owner);
}

void check_parameters(const Problem& problem) {
  for (const Parameter& parameter : problem.parameters()) {
    const auto is_odd = [](unsigned char letter) {
      return letter <= ' ' || std::string_view("=,\"\x7f").find(static_cast<char>(letter)) != std::string_view::npos;
    };
    if (parameter.name.empty() || std::ranges::any_of(parameter.name, is_odd)) {
      throw Error(
          "{}: a parameter name cannot be used in --set NAME=VALUE: it is empty or contains a "
          "space, control character, equals sign, comma or quotation mark",
          problem.name());
    }
    const std::string owner = "parameter " + parameter.name;
    require_one_line(problem, "the unit of " + owner, parameter.unit);
    require_one_line(problem, "the meaning of " + owner, parameter.meaning);
  }
}

void check_guess_sizes(const Problem& problem) {
  constexpr int points = 64;
  for (int i = 0; i <= points; ++i) {
    const double t = problem.horizon() * i / points;
    const MotionPoint point = call_formula(problem, "guess", [&] { return problem.guess(t); });
    const std::string flaw =
        flaw_of_sizes(point, problem.configuration_size(), problem.control_size(), problem.first_order_size());
    if (!flaw.empty()) throw Error("{}: guess({:g}): {}", problem.name(), t, flaw);
  }
}

void check_reference(const Problem& problem, const ReferenceOptimum& reference) {
  constexpr int most_digits = 17;  // of a double
  const std::string owner = problem.name() + ": card().reference";
  if (reference.digits < 0 || reference.digits > most_digits) {
    throw Error("{}.digits is {}, expected 0 to {}", owner, reference.digits, most_digits);
  }
  if (!std::isfinite(reference.objective)) throw Error(owner + ": the objective is not a finite number");
  require_one_line(problem, "card().reference.certificate", reference.certificate);
  require_one_line(problem, "card().reference.remark", reference.remark);
  for (const PublishedOptimum& published : reference.published) {
    if (!std::isfinite(published.objective)) throw Error(owner + ": a published objective is not a finite number");
    require_one_line(problem, "card().reference.published", published.source);
  }
}

/// Units are stated of all entries, or of none.
void check_units(const Problem& problem, const char* of, const std::vector<std::string>& units, Eigen::Index entries) {
  const std::string owner = fmt::format("card().{}", of);
  for (const std::string& unit : units) require_one_line(problem, owner, unit);
  if (units.empty() || std::ssize(units) == entries) return;
  throw Error("{}: {} has {}, expected {} or none", problem.name(), owner, counted(units.size(), "entry", "entries"),
              entries);
}

void check_card(const Problem& problem, const ProblemCard& card) {
  require_one_line(problem, "card().description", card.description);
  require_one_line(problem, "card().title", card.title);
  for (const std::string& unit : {card.axis_units.state, card.axis_units.control, card.axis_units.momentum,
                                  card.axis_units.cost, card.axis_units.energy}) {
    require_one_line(problem, "card().axis_units", unit);
  }
  require_one_line(problem, "card().source", card.source);
  require_one_line(problem, "card().guess", card.guess);
  require_one_line(problem, "card().time_unit", card.time_unit.name);
  for (const std::string& name : card.path_constraint_names) {
    require_one_line(problem, "card().path_constraint_names", name);
  }
  for (const std::string& name : card.boundary_condition_names) {
    require_one_line(problem, "card().boundary_condition_names", name);
  }
  if (!(card.time_unit.factor > 0.0) || !std::isfinite(card.time_unit.factor)) {
    throw Error("{}: card().time_unit.factor must be a positive number, got {:g}", problem.name(),
                card.time_unit.factor);
  }
  check_units(problem, "configuration_units", card.configuration_units, problem.configuration_size());
  check_units(problem, "control_units", card.control_units, problem.control_size());
  if (card.reference) check_reference(problem, *card.reference);
}

void check_picture(const Problem& problem) {
  const ControlledState x = point_of_inputs(problem);
  const Picture picture = call_formula(problem, "card().picture", [&] { return pictured_quantities(problem, x); });
  for (const PictureQuantity& quantity : picture) require_one_line(problem, "a unit of the picture", quantity.unit);
  require_names(problem, picture);
}

}  // namespace

void check_problem(const Problem& problem) try {
  check_parameters(problem);
  const TracedProblem traced(problem);
  static_cast<void>(problem_bounds(problem));
  check_guess_sizes(problem);
  static_cast<void>(positive_cost_scale(problem));
  check_card(problem, call_formula(problem, "card", [&] { return problem.card(); }));
  check_picture(problem);
} catch (const Error&) {
  throw;
} catch (...) {  // of a function that returns numbers, as horizon() or bounds()
  rethrow_naming(problem.name(), "a function");
}

double positive_cost_scale(const Problem& problem) {
  const double scale = call_formula(problem, "cost_scale", [&] { return problem.cost_scale(); });
  if (scale > 0.0 && std::isfinite(scale)) return scale;
  throw Error("{}: cost_scale must be a positive number, got {:g}", problem.name(), scale);
}

std::string flaw_of_sizes(const MotionPoint& point, Eigen::Index n, Eigen::Index m, Eigen::Index l) {
  const auto flaw_of = [](const char* name, const Eigen::VectorXd& part, Eigen::Index size) {
    return part.size() == size
               ? ""
               : fmt::format("{} has {}, expected {}", name, counted(part.size(), "entry", "entries"), size);
  };
  std::string flaw = flaw_of("q", point.q, n);
  if (flaw.empty()) flaw = flaw_of("v", point.v, n);
  if (flaw.empty()) flaw = flaw_of("u", point.u, m);
  if (flaw.empty()) flaw = flaw_of("y", point.y, l);
  return flaw;
}

}  // namespace dmocbench
