#include "methods/mechanics/problem_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void require_inside(double value, double lower, double upper, const std::string& subject) {
  // Ends are computed numbers: a value may miss its own bound by rounding.
  const double slack = 1e-12 * std::max(1.0, std::abs(value));
  if (value >= lower - slack && value <= upper + slack) return;
  throw Error("{} is {:g}, outside its bounds {:g} and {:g}", subject, value, lower, upper);
}

void require_state(const BoundaryState& state, const Problem& problem, const char* name) {
  const std::string subject = problem.name() + ": the boundary state " + member_name(name);
  for (const Eigen::VectorXd* part : {&state.q, &state.v}) {
    if (part->size() != problem.configuration_size()) {
      throw Error("{} has {}, expected {}", subject, counted(part->size(), "entry", "entries"),
                  problem.configuration_size());
    }
    if (!part->allFinite()) throw Error(subject + " is not finite");
  }
  if (state.y.size() != problem.first_order_size() || !state.y.allFinite()) {
    throw Error("{} needs {} finite numbers y, one per first-order state", subject, problem.first_order_size());
  }
}

void require_state_inside(const BoundaryState& state, const EndBounds& bounds, const Problem& problem,
                          const char* name) {
  const std::string subject = problem.name() + ": the boundary state " + member_name(name);
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    require_inside(state.q[i], bounds.q.lower[i], bounds.q.upper[i], fmt::format("{}: q[{}]", subject, i));
    require_inside(state.v[i], bounds.v.lower[i], bounds.v.upper[i], fmt::format("{}: v[{}]", subject, i));
  }
  for (Eigen::Index i = 0; i < state.y.size(); ++i) {
    require_inside(state.y[i], bounds.y.lower[i], bounds.y.upper[i], fmt::format("{}: y[{}]", subject, i));
  }
}

/// The bounds with `size` entries, none where `bounds` is empty. Errors begin with `subject`.
Bounds checked_bounds(const Bounds& bounds, Eigen::Index size, const std::string& subject) {
  if (bounds.empty()) return Bounds::none(size);
  for (const Eigen::VectorXd* side : {&bounds.lower, &bounds.upper}) {
    if (side->size() != size) {
      throw Error("{} has {}, expected {}", subject, counted(side->size(), "entry", "entries"), size);
    }
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::string entry = fmt::format("{}: entry {}", subject, i);
    if (std::isnan(bounds.lower[i]) || std::isnan(bounds.upper[i])) throw Error(entry + " is not a number");
    if (bounds.lower[i] == infinite || bounds.upper[i] == -infinite)
      throw Error(entry + " is infinite with the wrong sign");
    if (bounds.lower[i] > bounds.upper[i]) {
      throw Error("{} has the lower bound {:g} above the upper bound {:g}", entry, bounds.lower[i], bounds.upper[i]);
    }
  }
  return bounds;
}

/// Narrows the bounds of an end's nodes to the bounds of all nodes.
void narrow(Bounds& end, const Bounds& everywhere, const std::string& subject, char part) {
  for (Eigen::Index i = 0; i < end.lower.size(); ++i) {
    const double lower = std::max(end.lower[i], everywhere.lower[i]);
    const double upper = std::min(end.upper[i], everywhere.upper[i]);
    if (lower > upper) {
      throw Error("{} and {}{} leave no value for {}[{}]: {:g} to {:g} always, {:g} to {:g} at this time", subject,
                  member_name("bounds()."), part, part, i, everywhere.lower[i], everywhere.upper[i], end.lower[i],
                  end.upper[i]);
    }
    end.lower[i] = lower;
    end.upper[i] = upper;
  }
}

EndBounds checked_end(const EndBounds& end, const ProblemBounds& everywhere, const std::string& subject) {
  const Eigen::Index n = everywhere.q.lower.size();
  if (end.q.empty() || end.v.empty())
    throw Error("{} needs {} each for q and v", subject, counted(n, "entry", "entries"));
  EndBounds checked{checked_bounds(end.q, n, subject + ".q"), checked_bounds(end.v, n, subject + ".v"),
                    checked_bounds(end.y, everywhere.y.lower.size(), subject + ".y")};
  narrow(checked.q, everywhere.q, subject, 'q');
  narrow(checked.y, everywhere.y, subject, 'y');
  return checked;
}

/// By continuity the velocity of an end lies within the bounds that hold at the stages next to it.
void require_velocity_left(const Bounds& v, const Bounds& everywhere, const std::string& subject) {
  for (Eigen::Index i = 0; i < v.lower.size(); ++i) {
    const double lower = std::max(v.lower[i], everywhere.lower[i]);
    const double upper = std::min(v.upper[i], everywhere.upper[i]);
    const double slack = 1e-12 * std::max(1.0, std::abs(upper));
    if (lower <= upper + slack) continue;
    throw Error("{} and {} leave no value for v[{}]: the lower bound {:g} lies above the upper bound {:g}", subject,
                member_name("bounds().v"), i, lower, upper);
  }
}

/// The bounds between the ends, complete, in the order of their times.
std::vector<InteriorBounds> checked_interior(std::vector<InteriorBounds> interior, const ProblemBounds& everywhere,
                                             const std::string& name) {
  for (std::size_t j = 0; j < interior.size(); ++j) {
    InteriorBounds& at = interior[j];
    const std::string subject = fmt::format("{}[{}]", name, j);
    const bool is_inside = at.relative_time > 0.0 && at.relative_time < 1.0;  // not where it is not a number
    if (!is_inside) {
      throw Error("{}.relative_time is {:g}; it must lie between 0 and 1, as a share of the horizon", subject,
                  at.relative_time);
    }
    at.q = checked_bounds(at.q, everywhere.q.lower.size(), subject + ".q");
    at.v = checked_bounds(at.v, everywhere.v.lower.size(), subject + ".v");
    at.y = checked_bounds(at.y, everywhere.y.lower.size(), subject + ".y");
    narrow(at.q, everywhere.q, subject, 'q');
    narrow(at.y, everywhere.y, subject, 'y');
    require_velocity_left(at.v, everywhere.v, subject);
  }
  std::ranges::sort(interior, {}, &InteriorBounds::relative_time);
  const auto same = std::ranges::adjacent_find(interior, {}, &InteriorBounds::relative_time);
  if (same == interior.end()) return interior;
  throw Error("{} has two entries at the relative time {:g}; combine their bounds into one entry", name,
              same->relative_time);
}

void require_horizon(const Problem& problem, const HorizonBounds& bounds) {
  if (!(bounds.lower > 0.0) || !(bounds.upper >= bounds.lower)) {
    const std::string hint = bounds.upper == 0.0 ? fmt::format("; start from {}, which fixes the ends and the horizon",
                                                               member_name("Problem::bounds()"))
                                                 : "";
    throw Error("{}: {} must be positive and increasing, got {:g} and {:g}{}", problem.name(),
                member_name("bounds().horizon"), bounds.lower, bounds.upper, hint);
  }
}

}  // namespace

ProblemBounds problem_bounds(const Problem& problem) {
  const BoundaryState first = call_formula(problem, "initial_state", [&] { return problem.initial_state(); });
  const BoundaryState last = call_formula(problem, "final_state", [&] { return problem.final_state(); });
  const double horizon = call_formula(problem, "horizon", [&] { return problem.horizon(); });
  require_state(first, problem, "initial_state");
  require_state(last, problem, "final_state");
  if (!(horizon > 0.0) || !std::isfinite(horizon)) {
    throw Error("{}: the horizon must be {}, got {:g}", problem.name(), horizon > 0.0 ? "finite" : "positive", horizon);
  }
  ProblemBounds bounds = complete_bounds(problem, call_formula(problem, "bounds", [&] { return problem.bounds(); }));
  require_inside(horizon, bounds.horizon.lower, bounds.horizon.upper, problem.name() + ": horizon");
  require_state_inside(first, bounds.first, problem, "initial_state");
  require_state_inside(last, bounds.last, problem, "final_state");
  return bounds;
}

ProblemBounds complete_bounds(const Problem& problem, ProblemBounds bounds) {
  const Eigen::Index n = problem.configuration_size();
  const auto part = [&](const std::string& name) {
    return fmt::format("{}: {}", problem.name(), member_name("bounds()." + name));
  };
  require_horizon(problem, bounds.horizon);
  bounds.q = checked_bounds(bounds.q, n, part("q"));
  bounds.v = checked_bounds(bounds.v, n, part("v"));
  bounds.u = checked_bounds(bounds.u, problem.control_size(), part("u"));
  bounds.path = checked_bounds(bounds.path, bounds.path.lower.size(), part("path"));
  bounds.integrals = checked_bounds(bounds.integrals, bounds.integrals.lower.size(), part("integrals"));
  bounds.y = checked_bounds(bounds.y, problem.first_order_size(), part("y"));
  bounds.first = checked_end(bounds.first, bounds, part("first"));
  bounds.last = checked_end(bounds.last, bounds, part("last"));
  require_velocity_left(bounds.first.v, bounds.v, part("first"));
  require_velocity_left(bounds.last.v, bounds.v, part("last"));
  bounds.interior = checked_interior(std::move(bounds.interior), bounds, part("interior"));
  return bounds;
}

void require_bounds_of_formulas(const Problem& problem, const ProblemBounds& bounds, Eigen::Index path_constraints,
                                Eigen::Index integrals) {
  const auto require = [&](const char* part, const char* formula, const Bounds& given, Eigen::Index count) {
    if (given.lower.size() == count) return;
    throw Error("{}: {}{} has {}, but {} has {}", problem.name(), member_name("bounds()."), part,
                counted(given.lower.size(), "entry", "entries"), formula, count);
  };
  if (!bounds.path.empty()) require("path", "path_constraints", bounds.path, path_constraints);
  require("integrals", "integrands", bounds.integrals, integrals);
}

}  // namespace dmocbench
