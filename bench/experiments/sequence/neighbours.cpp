#include "bench/experiments/sequence/neighbours.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "bench/run/restated_problem.hpp"
#include "bench/run/uniform_01.hpp"

namespace dmocbench {

namespace {

class RecedingHorizon final : public Neighbours {
 public:
  RecedingHorizon(std::shared_ptr<const Problem> base, const Trajectory& first_motion, double share, std::uint64_t seed)
      : base_(std::move(base)),
        final_(base_->final_state()),
        range_q_(share * (first_motion.q.colwise().maxCoeff() - first_motion.q.colwise().minCoeff()).transpose()),
        range_v_(share * (first_motion.v.colwise().maxCoeff() - first_motion.v.colwise().minCoeff()).transpose()),
        engine_(seed) {}

  [[nodiscard]] std::string name() const override { return "receding_horizon"; }
  [[nodiscard]] bool moves_on() const override { return true; }
  [[nodiscard]] std::shared_ptr<const Problem> next(int /*step*/, const Trajectory& last) override {
    const MotionPoint node = last.node(1);
    initial_ = {node.q, node.v, node.y};
    disturb(initial_.q, range_q_);
    disturb(initial_.v, range_v_);
    final_.q += last.step(0) * final_.v;
    return std::make_shared<RestatedProblem>(
        base_, RestatedProblem::Changes{.initial = initial_, .final = final_, .cost_scale = base_->cost_scale()});
  }
  void give_values(Transcription& program) const override {
    program.set_initial_state(initial_);
    program.set_final_state(final_);
  }

 private:
  void disturb(Eigen::VectorXd& values, const Eigen::VectorXd& range) {
    for (Eigen::Index i = 0; i < values.size(); ++i) values[i] += (2.0 * uniform_01(engine_) - 1.0) * range[i];
  }

  std::shared_ptr<const Problem> base_;
  BoundaryState initial_;
  BoundaryState final_;
  Eigen::VectorXd range_q_;
  Eigen::VectorXd range_v_;
  std::mt19937_64 engine_;
};

class Homotopy final : public Neighbours {
 public:
  Homotopy(std::shared_ptr<const Problem> base, std::vector<std::string> settings, SweptQuantity quantity, int steps)
      : base_(std::move(base)), settings_(std::move(settings)), quantity_(std::move(quantity)), steps_(steps) {}

  [[nodiscard]] std::string name() const override { return "homotopy"; }
  [[nodiscard]] bool moves_on() const override { return false; }
  [[nodiscard]] std::shared_ptr<const Problem> next(int step, const Trajectory& /*last*/) override {
    const double share = static_cast<double>(step) / steps_;
    value_ = (1.0 - share) * quantity_.lower + share * quantity_.upper;
    instance_ = instance_of(base_, settings_, {quantity_}, {value_});
    return instance_;
  }
  void give_values(Transcription& program) const override {
    if (is_parameter()) {
      program.set_parameter(quantity_.name, value_);
      return;
    }
    program.set_initial_state(instance_->initial_state());
    program.set_final_state(instance_->final_state());
  }
  [[nodiscard]] std::vector<std::string> open_parameters() const override {
    return is_parameter() ? std::vector{quantity_.name} : std::vector<std::string>();
  }

 private:
  [[nodiscard]] bool is_parameter() const {
    return std::ranges::count(base_->parameters(), quantity_.name, &Parameter::name) > 0;
  }

  std::shared_ptr<const Problem> base_;
  std::vector<std::string> settings_;
  SweptQuantity quantity_;
  int steps_;
  double value_ = 0.0;
  std::shared_ptr<const Problem> instance_;
};

}  // namespace

std::unique_ptr<Neighbours> receding_horizon(std::shared_ptr<const Problem> base, const Trajectory& first_motion,
                                             double share, std::uint64_t seed) {
  return std::make_unique<RecedingHorizon>(std::move(base), first_motion, share, seed);
}

std::unique_ptr<Neighbours> homotopy(std::shared_ptr<const Problem> base, std::vector<std::string> settings,
                                     const SweptQuantity& quantity, int steps) {
  return std::make_unique<Homotopy>(std::move(base), std::move(settings), quantity, steps);
}

}  // namespace dmocbench
