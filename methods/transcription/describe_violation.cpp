#include "methods/transcription/describe_violation.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "methods/transcription/describe_constraint.hpp"

namespace dmocbench {

namespace {

struct Worst {
  std::size_t entry = 0;
  double amount = 0.0;
};

/// The entry farthest outside its bounds; the first that is not a number where there is one.
Worst farthest_outside(const Eigen::VectorXd& values, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  Worst worst;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const double amount = std::max(lower[i] - values[i], values[i] - upper[i]);
    if (std::isnan(values[i])) return {static_cast<std::size_t>(i), values[i]};
    if (amount > worst.amount) worst = {static_cast<std::size_t>(i), amount};
  }
  return worst;
}

std::string missed(const std::string& what, double amount) {
  std::ostringstream text;
  text.precision(3);
  if (std::isnan(amount)) {
    text << what << " is not a number.";
  } else {
    text << "Missed most is " << what << ", by " << amount << '.';
  }
  return text.str();
}

bool is_held(double value, double bound) {
  return std::isfinite(bound) && std::abs(value - bound) <= 1e-6 * std::max(1.0, std::abs(bound));
}

/// The controls that their bounds hold in most intervals.
std::string held_controls(const Problem& problem, const Transcription& transcription, const Eigen::VectorXd& x) {
  const Layout& layout = transcription.layout();
  const auto intervals = static_cast<Eigen::Index>(layout.intervals());
  const Eigen::Index stages = intervals * layout.stages();
  std::string text;
  for (Eigen::Index i = 0; i < layout.shape().control_size; ++i) {
    Eigen::Index held = 0;
    for (Eigen::Index stage = 0; stage < layout.stages(); ++stage) {
      const auto head = static_cast<Eigen::Index>(layout.control_column(stage, i));
      for (Eigen::Index k = head; k < head + intervals; ++k) {
        if (is_held(x[k], transcription.variable_lower()[k]) || is_held(x[k], transcription.variable_upper()[k]))
          ++held;
      }
    }
    if (2 * held <= stages) continue;
    text += " bounds().u holds u[" + std::to_string(i) + "] (" + problem.control_names()[static_cast<std::size_t>(i)] +
            ") at " + std::to_string(held) + " of " + std::to_string(stages) + " stages.";
  }
  return text;
}

std::string held_horizon(const Problem& problem, const Transcription& transcription, const Eigen::VectorXd& x) {
  if (!transcription.has_free_horizon()) return "";
  const HorizonBounds bounds = problem.bounds().horizon;
  const double horizon = transcription.horizon(x);
  if (is_held(horizon, bounds.lower)) return " bounds().horizon holds T at its lower bound.";
  if (is_held(horizon, bounds.upper)) return " bounds().horizon holds T at its upper bound.";
  return "";
}

/// What the constraints that contradict each other are made of.
std::string contradiction(const Transcription& transcription) {
  std::vector<std::string> parts;
  const EndBounds& last = transcription.bounds().last;
  if (last.q.any() || last.v.any()) parts.emplace_back("final_state");
  if (transcription.layout().shape().conditions > 0) parts.emplace_back("boundary_conditions");
  if (transcription.traced_problem().path_constraint_count() > 0) parts.emplace_back("path_constraints");
  if (parts.empty()) return "";
  std::string text = " No motion near this one meets " + parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) text += (i + 1 < parts.size() ? ", " : " and ") + parts[i];
  return text + " within the bounds and the horizon.";
}

}  // namespace

std::string describe_violation(const Problem& problem, Transcription& transcription, const Solution& solution,
                               double tolerance) {
  const Eigen::VectorXd& x = solution.primal;
  if (is_solved(solution.status) || static_cast<std::size_t>(x.size()) != transcription.variable_count()) return "";
  Eigen::VectorXd rows(static_cast<Eigen::Index>(transcription.constraint_count()));
  transcription.constraints(x, rows);
  const Worst row = farthest_outside(rows, transcription.constraint_lower(), transcription.constraint_upper());
  const Worst unknown = farthest_outside(x, transcription.variable_lower(), transcription.variable_upper());
  const bool is_unknown = std::isnan(unknown.amount) || unknown.amount > row.amount;
  const Worst worst = is_unknown ? unknown : row;
  if (worst.amount <= tolerance) return "";
  std::string text = missed(is_unknown ? unknown_in_words(problem, transcription, x, worst.entry)
                                       : describe_constraint(problem, transcription, x, worst.entry),
                            worst.amount);
  if (std::isnan(worst.amount)) return text;
  text += held_controls(problem, transcription, x) + held_horizon(problem, transcription, x);
  if (solution.status == Status::infeasible) text += contradiction(transcription);
  return text;
}

}  // namespace dmocbench
