#include "methods/solvers/batch/lane_problem.hpp"

#include <algorithm>
#include <utility>

#include "methods/judgement/newton_correction.hpp"
#include "methods/kkt/linearisation.hpp"
#include "methods/runtime/vector_loops.hpp"

namespace dmocbench::batch {

LaneProblem::LaneProblem(const NonlinearProgram& program, std::unique_ptr<LaneProgram> lanes)
    : program_(program),
      lanes_(std::move(lanes)),
      inequalities_(inequalities_of(program)),
      fixed_(fixed_variables(program)),
      usual_rows_(program.constraint_lower()),
      bounds_(program, inequalities_),
      variables_(static_cast<Eigen::Index>(program.variable_count())),
      constraints_(static_cast<Eigen::Index>(program.constraint_count())),
      rows_(constraints_),
      gradient_(variables_),
      jacobian_(static_cast<Eigen::Index>(program.jacobian_structure().size())),
      hessian_(static_cast<Eigen::Index>(program.hessian_structure().size())),
      of_lagrangian_(primal_count()) {}

void LaneProblem::set_equality_values(std::size_t lane, const Eigen::VectorXd& values) {
  rows_.of(lane) = values.size() > 0 ? values : usual_rows_;
  for (const Eigen::Index row : inequalities_) rows_.of(lane)[row] = 0.0;
}

void LaneProblem::evaluate(const LaneMask& fresh, const OfLanes& push, LaneVector& primal, LaneValues& values) {
  lanes_->objective(primal.data(), values.objective.data());
  lanes_->constraints(primal.data(), values.constraints.data());
  for (Eigen::Index j = 0; const Eigen::Index row : inequalities_) {
    const Eigen::Index slack = variables_ + j++;
    for (std::size_t lane = 0; lane < instance_lanes; ++lane) {
      if (!fresh[lane]) continue;
      primal.of(lane)[slack] = values.constraints.of(lane)[row];
    }
  }
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) {
    if (fresh[lane]) {
      bounds_.push_inside(lane, push[static_cast<Eigen::Index>(lane)], variables_, primal_count(), primal);
    }
  }
  for (Eigen::Index j = 0; const Eigen::Index row : inequalities_) {
    values.constraints[row] -= primal[variables_ + j++];
  }
  lane_loops().subtract(values.constraints.data(), rows_.data(), constraints_, values.theta.data(),
                        values.violation.data());
  values.barrier = has_bounds() ? bounds_.barrier(primal) : OfLanes::Zero();
}

void LaneProblem::differentiate(const LaneVector& primal) {
  lanes_->gradient(primal.data(), gradient_.data());
  lanes_->jacobian(primal.data(), jacobian_.data());
}

void LaneProblem::evaluate_hessian(const LaneVector& primal, const LaneVector& multipliers) {
  lanes_->hessian(primal.data(), multipliers.data(), hessian_.data());
}

void LaneProblem::find_gradient_of_lagrangian(const LaneVector& multipliers) {
  std::copy_n(gradient_.data(), variables_ * width, of_lagrangian_.data());
  for (const PatternRun& run : program_.jacobian_structure().runs()) {
    const auto add = [&](Eigen::Index i, Eigen::Index length) {
      vector_loops().add_products(of_lagrangian_.data() + (run.column + i * run.column_step) * width,
                                  jacobian_.data() + (run.entry + i) * width,
                                  multipliers.data() + (run.row + i * run.row_step) * width, length * width);
    };
    if (run.row_step == 1 && run.column_step == 1) {
      add(0, run.length);
    } else {
      for (Eigen::Index i = 0; i < run.length; ++i) add(i, 1);
    }
  }
  for (Eigen::Index j = 0; const Eigen::Index row : inequalities_) of_lagrangian_[variables_ + j++] = -multipliers[row];
  for (const Eigen::Index i : fixed_) of_lagrangian_[i].setZero();
}

OfLanes LaneProblem::length_of(const LaneVector& step, const LaneVector& primal, const OfLanes& change_of_objective,
                               const OfLanes& objective) const {
  const auto largest = [](const LaneVector& vector, Eigen::Index first, Eigen::Index count) {
    OfLanes result;
    lane_loops().largest(vector.data() + first * width, count, result.data());
    return result;
  };
  const OfLanes least = NewtonCorrections::smallest_share * largest(primal, 0, variables_).max(1.0);
  OfLanes length = change_of_objective.abs() / objective.abs().max(1.0);
  for (const PlaceRun& run : program_.interval_structure()->unknowns.runs()) {
    const auto first = static_cast<Eigen::Index>(run.first);
    const auto count = static_cast<Eigen::Index>(run.count);
    const OfLanes moves = largest(step, first, count);
    length = length.max((moves > 0.0).select(moves / largest(primal, first, count).max(least), 0.0));
  }
  return length;
}

}  // namespace dmocbench::batch
