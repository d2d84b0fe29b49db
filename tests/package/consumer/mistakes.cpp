// Mistakes in the statement of a problem and in calls, and what their makers are told: one line each on standard
// output, and exit code 1 if a sentence does not name what is wrong.
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include <dmocbench/dmocbench.hpp>

using namespace dmocbench;

namespace {

// Two masses on a line, tied by a spring, each with a force of its own. Every mistake below is made in it.
struct TwoMasses : Problem {
  using Problem::Problem;
  std::vector<std::string> configuration_names() const override { return {"left", "right"}; }
  std::vector<std::string> control_names() const override { return {"push", "pull"}; }
  Expression lagrangian(const State& x) const override {
    const Expression stretch = x.q[1] - x.q[0];
    return 0.5 * (x.v[0] * x.v[0] + x.v[1] * x.v[1] - stretch * stretch);
  }
  ExpressionVector force(const ControlledState& x) const override { return x.u; }
  Expression running_cost(const ControlledState& x) const override { return 0.5 * (x.u[0] * x.u[0] + x.u[1] * x.u[1]); }
  BoundaryState initial_state() const override { return BoundaryState::at_rest(Eigen::Vector2d(0.0, 1.0)); }
  BoundaryState final_state() const override { return BoundaryState::at_rest(Eigen::Vector2d(1.0, 2.0)); }
  double horizon() const override { return 2.0; }
};

struct ForceTooShort : TwoMasses {
  ExpressionVector force(const ControlledState& x) const override { return ExpressionVector::Constant(1, x.u[0]); }
};
struct ForceForgotten : TwoMasses {
  ExpressionVector force(const ControlledState& x) const override { return 0.0 * x.v; }
};
struct OneControlForgotten : TwoMasses {
  ExpressionVector force(const ControlledState& x) const override {
    ExpressionVector f = x.u;
    f[1] = 0.0;
    return f;
  }
  Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }
};
struct ForceReadsFar : TwoMasses {
  ExpressionVector force(const ControlledState& x) const override { return ExpressionVector::Constant(2, x.u[2]); }
};
struct VelocityReadsFar : TwoMasses {
  Expression lagrangian(const State& x) const override { return 0.5 * x.v[2] * x.v[2]; }
};
struct NegativeEntry : TwoMasses {
  Expression lagrangian(const State& x) const override { return 0.5 * x.v[-1] * x.v[0]; }
};
struct HalfIsAnInteger : TwoMasses {
  Expression lagrangian(const State& x) const override { return 1 / 2 * (x.v[0] * x.v[0] + x.v[1] * x.v[1]); }
};
struct MassForgotten : TwoMasses {
  Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0] - x.q[1]; }
};
struct SingularMass : TwoMasses {
  Expression lagrangian(const State& x) const override { return 0.5 * pow(x.v[0] + x.v[1], 2); }
};
struct NegativeLogarithm : TwoMasses {
  Expression lagrangian(const State& x) const override { return TwoMasses::lagrangian(x) + log(x.q[0] - 0.5); }
};
struct CostOfNegativeRoot : TwoMasses {
  Expression running_cost(const ControlledState& x) const override {
    return TwoMasses::running_cost(x) + sqrt(x.q[0] - 5.0);
  }
};
struct UnboundedCost : TwoMasses {
  Expression running_cost(const ControlledState& x) const override { return -x.u[0] * x.u[0] + x.u[1] * x.u[1]; }
};
struct StartTooShort : TwoMasses {
  BoundaryState initial_state() const override { return BoundaryState::at_rest(Eigen::VectorXd::Zero(1)); }
};
struct EndIsNan : TwoMasses {
  BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::Vector2d(1.0, std::numeric_limits<double>::quiet_NaN()));
  }
};
struct VelocityForgotten : TwoMasses {
  BoundaryState final_state() const override { return {.q = Eigen::Vector2d(1.0, 2.0), .v = {}}; }
};
struct HorizonZero : TwoMasses {
  double horizon() const override { return 0.0; }
};
struct HorizonNegative : TwoMasses {
  double horizon() const override { return -2.0; }
};
struct NoConfiguration : TwoMasses {
  std::vector<std::string> configuration_names() const override { return {}; }
};
struct SameNameTwice : TwoMasses {
  std::vector<std::string> configuration_names() const override { return {"x", "x"}; }
};
struct EmptyName : TwoMasses {
  std::vector<std::string> control_names() const override { return {"push", ""}; }
};
struct NameWithComma : TwoMasses {
  std::vector<std::string> configuration_names() const override { return {"left, in m", "right"}; }
};
struct OneControlName : TwoMasses {
  std::vector<std::string> control_names() const override { return {"push"}; }
};
struct BoundsTooShort : TwoMasses {
  ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.u = Bounds::all(1, -1.0, 1.0);
    return bounds;
  }
};
struct BoundsCrossed : TwoMasses {
  ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.u = Bounds::all(2, 1.0, -1.0);
    return bounds;
  }
};
struct BoundsAreNan : TwoMasses {
  ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.q = Bounds::all(2, -std::numeric_limits<double>::quiet_NaN(), 1.0);
    return bounds;
  }
};
struct BoundsFromNothing : TwoMasses {  // forgets to begin with Problem::bounds()
  ProblemBounds bounds() const override {
    ProblemBounds bounds;
    bounds.u = Bounds::all(2, -9.0, 9.0);
    return bounds;
  }
};
struct HorizonBelowZero : TwoMasses {
  ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.horizon = {.lower = -1.0, .upper = 3.0};
    return bounds;
  }
};
struct EndOutsideOfBounds : TwoMasses {
  ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.q = Bounds::all(2, -0.5, 1.5);
    return bounds;
  }
};
struct TooWeak : TwoMasses {
  ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.u = Bounds::all(2, -0.1, 0.1);
    return bounds;
  }
};
struct PathIsNan : TwoMasses {
  ExpressionVector path_constraints(const ControlledState& x) const override {
    return ExpressionVector::Constant(1, log(x.q[0] - 3.0));
  }
};
struct PathNamesTooMany : TwoMasses {
  ExpressionVector path_constraints(const ControlledState& x) const override {
    return ExpressionVector::Constant(1, x.q[1] - x.q[0]);
  }
  ProblemCard card() const override { return {.path_constraint_names = {"one", "two"}}; }
};
struct ConditionIsConstant : TwoMasses {
  ExpressionVector boundary_conditions(const State&, const State&) const override {
    return ExpressionVector::Constant(1, 1.0);
  }
};
struct GuessTooShort : TwoMasses {
  MotionPoint guess(double) const override {
    return {.q = Eigen::VectorXd::Zero(1), .v = Eigen::VectorXd::Zero(2), .u = Eigen::VectorXd::Zero(2)};
  }
};
struct GuessWithoutControl : TwoMasses {
  MotionPoint guess(double) const override {
    return {.q = Eigen::VectorXd::Zero(2), .v = Eigen::VectorXd::Zero(2), .u = {}};
  }
};
struct GuessIsNan : TwoMasses {
  MotionPoint guess(double t) const override {
    MotionPoint point = TwoMasses::guess(t);
    point.q[1] = std::log(-1.0 - t);
    return point;
  }
};
struct ScaleZero : TwoMasses {
  double cost_scale() const override { return 0.0; }
};
struct UnknownParameter : TwoMasses {
  UnknownParameter() : TwoMasses({{.name = "spring", .value = 1.0, .unit = "N/m", .meaning = "its stiffness"}}) {}
  Expression lagrangian(const State& x) const override { return parameter("sprign") * x.v[0] * x.v[1]; }
};
struct ParameterOutside : TwoMasses {
  ParameterOutside() : TwoMasses({{.name = "mass", .value = -1.0, .unit = "kg", .meaning = "of both", .lower = 0.0}}) {}
};
struct ParameterTwice : TwoMasses {
  ParameterTwice() : TwoMasses({{.name = "mass", .value = 1.0}, {.name = "mass", .value = 2.0}}) {}
};
struct SymmetryTooShort : TwoMasses {
  std::optional<ExpressionVector> symmetry(const ExpressionVector&) const override {
    return ExpressionVector::Constant(1, Expression(1.0));
  }
};
struct SizesDoNotFit : TwoMasses {
  ExpressionVector force(const ControlledState& x) const override { return Eigen::MatrixXd::Identity(3, 3) * x.u; }
};

// What the maker is told on the way from the statement to a judged answer.
std::string told_of(const Problem& problem, const std::string& method) {
  Transcription program(problem, *make_element(method), gauss_tableau(1), Grid::uniform(16));
  const Solution solution = make_solver("interior_point")->solve(program, sample(program, guessed_motion(problem)));
  std::string told = std::string(name_of(solution.status)) + ": " + solution.message;
  if (!is_solved(solution.status)) told += " " + describe_violation(problem, program, solution);
  return told;
}

template <class Mistaken>
std::function<std::string()> statement(const std::string& method = "dmoc") {
  return [method] { return told_of(Mistaken(), method); };
}

Transcription plain(long long intervals = 8) {
  static const TwoMasses problem;
  return {problem, *make_element("dmoc"), gauss_tableau(1), Grid::uniform(intervals)};
}

std::string message_from(const Eigen::VectorXd& start) {
  Transcription program = plain();
  return make_solver("interior_point")->solve(program, start).message;
}

struct Mistake {
  std::string name;
  std::string wanted;  // what the sentence has to contain
  std::function<std::string()> make;
};

const std::vector<Mistake>& mistakes() {
  static const std::vector<Mistake> all = {
      {"ForceTooShort", "force has 1 entry, expected 2", statement<ForceTooShort>()},
      {"ForceForgotten", "The force does not depend on any control", statement<ForceForgotten>()},
      {"OneControlForgotten", "no formula depends on the control pull", statement<OneControlForgotten>()},
      {"ForceReadsFar", "a formula reads u[2], but u has 2 entries", statement<ForceReadsFar>()},
      {"VelocityReadsFar", "a formula reads v[2]", statement<VelocityReadsFar>()},
      {"NegativeEntry", "a formula reads v[-1]", statement<NegativeEntry>()},
      {"HalfIsAnInteger", "L_vv has a zero row for left", statement<HalfIsAnInteger>()},
      {"MassForgotten", "L_vv has a zero row for right", statement<MassForgotten>()},
      {"SingularMass", "L_vv is singular", statement<SingularMass>()},
      {"NegativeLogarithm", "lagrangian is not a number", statement<NegativeLogarithm>()},
      {"CostOfNegativeRoot", "running_cost is not a number", statement<CostOfNegativeRoot>()},
      {"UnboundedCost", "may have no lower bound", statement<UnboundedCost>()},
      {"StartTooShort", "initial_state has 1 entry, expected 2", statement<StartTooShort>()},
      {"EndIsNan", "final_state is not finite", statement<EndIsNan>()},
      {"VelocityForgotten", "final_state has 0 entries, expected 2", statement<VelocityForgotten>()},
      {"HorizonZero", "the horizon must be positive, got 0", statement<HorizonZero>()},
      {"HorizonNegative", "the horizon must be positive, got -2", statement<HorizonNegative>()},
      {"NoConfiguration", "configuration_names is empty", statement<NoConfiguration>()},
      {"SameNameTwice", "\"x\" is used twice", statement<SameNameTwice>()},
      {"EmptyName", "cannot name a column", statement<EmptyName>()},
      {"NameWithComma", "\"left, in m\" cannot name a column", statement<NameWithComma>()},
      {"OneControlName", "u has 1 entry", statement<OneControlName>()},
      {"BoundsTooShort", "bounds().u has 1 entry, expected 2", statement<BoundsTooShort>()},
      {"BoundsCrossed", "the lower bound 1 above the upper bound -1", statement<BoundsCrossed>()},
      {"BoundsAreNan", "bounds().q: entry 0 is not a number", statement<BoundsAreNan>()},
      {"BoundsFromNothing", "start from Problem::bounds()", statement<BoundsFromNothing>()},
      {"HorizonBelowZero", "got -1 and 3", statement<HorizonBelowZero>()},
      {"EndOutsideOfBounds", "bounds().last and bounds().q leave no value for q[1]", statement<EndOutsideOfBounds>()},
      {"TooWeak", "bounds().u is active for u[0] (push) at 16 of 16 stages", statement<TooWeak>()},
      {"PathIsNan", "path_constraints is not a number", statement<PathIsNan>()},
      {"PathNamesTooMany", "path_constraint_names has 2 entries, expected 1", statement<PathNamesTooMany>()},
      {"ConditionIsConstant", "is 1, in boundary_conditions[0]", statement<ConditionIsConstant>()},
      {"GuessTooShort", "q has 1 entry, expected 2", statement<GuessTooShort>()},
      {"GuessWithoutControl", "u has 0 entries, expected 2", statement<GuessWithoutControl>()},
      {"GuessIsNan", "the guess itself is not a number", statement<GuessIsNan>()},
      {"ScaleZero", "cost_scale must be a positive number, got 0", statement<ScaleZero>()},
      {"UnknownParameter", "has no parameter \"sprign\"; choose one of spring", statement<UnknownParameter>()},
      {"ParameterOutside", "parameter mass must be a number in [0, inf] (kg), got -1", statement<ParameterOutside>()},
      {"ParameterTwice", "two parameters are named mass", statement<ParameterTwice>()},
      {"SymmetryTooShort", "symmetry has 1 entry, expected 2", statement<SymmetryTooShort>()},
      {"SizesDoNotFit", "cannot multiply a 3 x 3 matrix by a 2 x 1 matrix", statement<SizesDoNotFit>()},
      {"no such method", "multiple_shooting_rk4_1", [] { return told_of(TwoMasses(), "dmcc"); }},
      {"a tableau of 9 stages", "1 to 4 stages, got 9", [] { return std::to_string(gauss_tableau(9).b.size()); }},
      {"no such tableau", "choose one of gauss", [] { return std::to_string(make_tableau("radau", 2).b.size()); }},
      {"a grid without intervals", "got 0", [] { return std::to_string(plain(0).variable_count()); }},
      {"no such solver", "choose one of ipopt", [] { return make_solver("snopt")->name(); }},
      {"a start of the wrong size", "the start has 3 entries, but the program has 34 variables",
       [] { return message_from(Eigen::VectorXd::Zero(3)); }},
      {"a start that is not a number", "Entry 0 of the start is nan",
       [] { return message_from(Eigen::VectorXd::Constant(34, std::numeric_limits<double>::quiet_NaN())); }},
      {"a point of the wrong size", "needs 34 variables, got 3",
       [] {
         Transcription program = plain();
         return std::to_string(read_trajectory(program, Eigen::VectorXd::Zero(3), Eigen::VectorXd()).cost);
       }},
      {"a parameter that is not there", "has no parameter \"mass\"",
       [] {
         TwoMasses().set_parameter("mass", 1.0);
         return std::string("set");
       }},
      {"a copy without clone", "copy_of(*this)", [] { return TwoMasses().clone()->name(); }},
      {"a table that is not there", "cannot read nowhere_nodes.csv",
       [] { return std::to_string(read_motion_tables(TwoMasses(), "nowhere_nodes.csv").q.size()); }},
  };
  return all;
}

}  // namespace

int main() {
  int failed = 0;
  for (const Mistake& mistake : mistakes()) {
    std::string told;
    try {
      told = mistake.make();
    } catch (const Error& error) {
      told = error.what();
    } catch (const std::exception& error) {
      told = std::string("NOT AN ERROR OF OURS: ") + error.what();
    }
    const bool is_named = told.find(mistake.wanted) != std::string::npos;
    failed += is_named ? 0 : 1;
    std::cout << (is_named ? "" : "WEAK ") << mistake.name << ": " << told << std::endl;
  }
  return failed == 0 ? 0 : 1;
}
