#include "methods/tables/motion_file.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/run/described_tables.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/start_provider.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "problems/cart_pole_cartesian.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/wider_problems.hpp"

namespace dmocbench {
namespace {

using tests::expect_error_naming;

/// A motion of the double integrator on four intervals of a quarter, in the files X_nodes.csv and X_stages.csv.
class MotionFile : public tests::InTemporaryFolder {
 protected:
  static constexpr const char* nodes_text = "t,q,v_q\n0,0,0\n0.25,0.1,1\n0.5,0.5,1.5\n0.75,0.9,1\n1,1,0\n";
  static constexpr const char* stages_text = "t,u\n0.125,4\n0.375,2\n0.625,-2\n0.875,-4\n";

  void SetUp() override {
    InTemporaryFolder::SetUp();
    write(nodes_text, stages_text);
  }
  void write(const std::string& nodes, const std::string& stages) const {
    write_file(nodes_file(), nodes);
    write_file(folder() / "X_stages.csv", stages);
  }
  [[nodiscard]] std::filesystem::path nodes_file() const { return folder() / "X_nodes.csv"; }
  [[nodiscard]] Motion motion_in(const std::filesystem::path& file) const {
    return smooth_motion(read_motion_tables(*problem_, file));
  }
  [[nodiscard]] Motion read() const { return motion_in(nodes_file()); }
  /// Asks for the start in the file as an experiment does.
  void provide() const {
    StartProvider starts({.start = nodes_file().string()}, {});
    const Case the_case{.problem = problem_, .method = "dmoc", .grid = Grid::uniform(8)};
    starts.check({the_case});
    EXPECT_EQ(starts.start_for(the_case).motion.at(0.5).q[0], 0.5);
  }

  std::shared_ptr<const Problem> problem_ = make_problem("double_integrator");
};

TEST_F(MotionFile, GivesNodesVelocitiesAndControls) {
  const Motion motion = read();
  EXPECT_EQ(motion.horizon, 1.0);
  EXPECT_DOUBLE_EQ(motion.at(0.25).q[0], 0.1);
  EXPECT_DOUBLE_EQ(motion.at(0.5).v[0], 1.5);
  EXPECT_DOUBLE_EQ(motion.at(0.25).u[0], 3.0);
}

TEST_F(MotionFile, IsRefusedWithItsNameWhereItIsNoMotion) {
  const auto expect = [&](const std::string& nodes, const std::string& stages,
                          std::initializer_list<std::string> words) {
    write(nodes, stages);
    expect_error_naming(words, [&] { static_cast<void>(read()); });
  };
  expect("t,q,v_q\n0,0,0\n0.25,nan,1\n1,1,0\n", stages_text, {"X_nodes.csv", "column q"});
  expect("t,q,v_q\n0,0,0\n0.25,0,inf\n1,1,0\n", stages_text, {"X_nodes.csv", "column v_q"});
  expect("t,q,v_q\n0,0,0\n0.25,0\n1,1,0\n", stages_text, {"X_nodes.csv", "record 3"});
  expect("t,q,v_q\n0,0,0\n0.5,0,0\n0.5,0,0\n1,1,0\n", stages_text, {"X_nodes.csv", "increasing"});
  expect("t,q,v_q\n0.1,0,0\n1,1,0\n", stages_text, {"X_nodes.csv", "begin at 0"});
  expect("t,q,v_q\n0,0,0\n", stages_text, {"X_nodes.csv", "no trajectory"});
  expect("t,q,v_q\n0,0,0\n0.25,0.1,1\n0.5,0.5,1.5\n", stages_text, {"X_stages.csv", "truncated"});
  expect(nodes_text, "t,u\n0.125,4\n0.375,2\n", {"X_stages.csv", "truncated"});
  const std::string costates = "t,q,v_q,psi_q_q,psi_p_q\n0,0,0,1,1\n0.5,0.5,1,";
  expect(costates + "x,1\n1,1,0,1,1\n", stages_text, {"X_nodes.csv", "column psi_q_q"});
  expect(costates + "1,\n1,1,0,1,1\n", stages_text, {"X_nodes.csv", "column psi_p_q"});
  expect("t,q,v_q\n0,0,0\n500,0.5,1\n1000,1,0\n", "t,u\n250,4\n750,-4\n", {"X_nodes.csv", "1000", "double_integrator"});
}

TEST_F(MotionFile, HoldsPhasesOneAfterTheOther) {
  for (const std::string name : {"bouncing_ball", "two_stage_rocket", "swing_and_release"}) {
    SCOPED_TRACE(name);
    const auto problem = make_problem(name);
    const Trajectory motion = tests::confirmed(*problem, {"tangent", 2}, 8, guessed_motion(*problem), 1e-9).motion;
    const Table nodes = node_table(*problem, motion);
    const std::string first = problem->phased()->phases()[0].name;
    ASSERT_EQ(nodes.rows().size(), 18U);
    EXPECT_EQ(nodes.rows()[8].text("phase"), first);
    EXPECT_NE(nodes.rows()[9].text("phase"), first);
    EXPECT_NEAR(nodes.rows()[9].needed("t"), nodes.rows()[8].needed("t"), 1e-15);  // both sides of the switch
    EXPECT_NEAR(nodes.rows()[8].needed("t"), nodes.rows()[0].needed("duration_" + first), 1e-15);
    write_motion(*problem, motion, nodes_file());
    const Trajectory read = read_motion_tables(*problem, nodes_file());
    EXPECT_LT((read.node_times - motion.node_times).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((read.q - motion.q).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((read.v - motion.v).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((read.psi_p - motion.psi_p).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_EQ(read.stage_u, motion.stage_u);
    EXPECT_EQ(read.unknowns, motion.unknowns);
    EXPECT_EQ(read.y, motion.y);
    // Without the columns of durations they are the ones of the rows.
    std::vector<std::string> header = nodes.columns();
    std::erase_if(header, [](const std::string& column) { return column.starts_with("duration_"); });
    EXPECT_LT(header.size(), nodes.columns().size());
    Table without(header);
    for (const Row& row : nodes.rows()) without.append(row);
    write_file(nodes_file(), without.csv());
    EXPECT_LT((read_motion_tables(*problem, nodes_file()).unknowns - motion.unknowns).cwiseAbs().maxCoeff(), 1e-14);
  }
  const auto ball = make_problem("bouncing_ball");
  const Trajectory motion = tests::confirmed(*ball, {"dmoc", 1}, 8, guessed_motion(*ball), 1e-9).motion;
  const Row before = node_table(*ball, motion).rows()[8];
  const Row after = node_table(*ball, motion).rows()[9];
  EXPECT_NEAR(after.needed("v_height"), -0.7 * before.needed("v_height"), 1e-12);
  EXPECT_NEAR(after.needed("v_height") - before.needed("v_height"), before.needed("impulse"), 1e-12);
  EXPECT_EQ(picture_table(*ball, motion).columns(),
            (std::vector<std::string>{"t_in_s", "phase", "height_in_m", "thrust_in_N"}));
}

TEST_F(MotionFile, NeedsNoStagesBesideIt) {
  std::filesystem::remove(folder() / "X_stages.csv");
  EXPECT_EQ(read().at(0.5).u, problem_->guess(0.5).u);
  write_file(nodes_file(), "\xEF\xBB\xBFu,v_q,q,t\r\n4,0,0,0\r\n0,1.5,0.5,0.5\r\n-4,0,1,1\r\n");
  EXPECT_DOUBLE_EQ(read().at(0.25).u[0], 2.0);
  EXPECT_DOUBLE_EQ(read().at(0.5).q[0], 0.5);
  std::filesystem::rename(nodes_file(), folder() / "mine.csv");
  EXPECT_DOUBLE_EQ(motion_in(folder() / "mine.csv").at(1.0).q[0], 1.0);
  write_file(nodes_file(), "t,q,v_q\n0.1,0,0\n1,1,0\n");
  expect_error_naming({"X_nodes.csv", "begin at 0"}, [&] { static_cast<void>(read()); });
}

TEST_F(MotionFile, ServesWhateverElseLiesBesideIt) {
  for (const char* const text :
       {R"({"motions": 5})", R"({"motions": [5]})", R"({"motions": [{"nodes": 7}]})", R"({"motions": {"a": {}}})",
        R"({"motions": [{"nodes": "X_nodes.csv", "method": 3}]})", "[", "5", "null", ""}) {
    write_file(folder() / "other.json", text);
    EXPECT_NO_THROW(provide()) << text;
  }
  std::filesystem::create_directory(folder() / "folder.json");
  std::filesystem::create_symlink("nowhere", folder() / "link.json");
  EXPECT_NO_THROW(provide());
}

TEST_F(MotionFile, IsRefusedWhereItIsNotAsItsRunWroteIt) {
  const nlohmann::json motion{{"nodes", "X_nodes.csv"},
                              {"problem", "double_integrator"},
                              {"method", "dmoc"},
                              {"tableau", "gauss"},
                              {"stages", 1},
                              {"intervals", 4}};
  const nlohmann::json told = nlohmann::json(describe_tables({nodes_file(), folder() / "X_stages.csv"}));
  write_file(folder() / "X.json", nlohmann::json{{"motions", {motion}}, {"tables", told}}.dump());
  EXPECT_NO_THROW(provide());
  write(nodes_text, "t,u\n0.125,4\n0.375,2\n0.625,-2\n0.875,-5\n");
  expect_error_naming({"X_stages.csv", "X.json", "another name"}, [&] { provide(); });
}

TEST(QuantityTable, HasTheBoundsOfPathConstraintsAndOfTimesBetweenTheEnds) {
  const Table forces = quantity_table(tests::TwoForces());
  const Row& path = forces.rows().back();
  EXPECT_EQ(path.text("kind"), "h");
  EXPECT_EQ(path.text("lower"), "0");
  EXPECT_EQ(path.text("upper"), "0");
  std::vector<double> waypoint;
  const Table waypoints = quantity_table(*make_problem("waypoints"));
  for (const Row& row : waypoints.rows()) {
    if (row.text("quantity") == "x" && !row.text("time").empty()) waypoint.push_back(row.needed("upper"));
  }
  EXPECT_EQ(waypoint, (std::vector{4.0, 6.0}));
}

TEST(StageTable, HasTheForceOfTheRodThatCarriesAHangingBob) {
  const CartPoleCartesian problem;
  const double length = problem.parameter("length");
  Trajectory hanging;
  hanging.tableau = gauss_tableau(1);
  hanging.stage_times = Eigen::VectorXd::Constant(1, 0.5);
  hanging.stage_q = Eigen::RowVector3d(0.0, 0.0, -length);
  hanging.stage_v = Eigen::RowVector3d::Zero();
  hanging.stage_u = Eigen::MatrixXd::Zero(1, 1);
  const Table stages = stage_table(problem, hanging);
  // -Gᵀλ = 2 l λ e_y balances the weight.
  const double lambda = 0.5 * problem.parameter("bob_mass") * problem.parameter("gravity") / length;
  EXPECT_NEAR(stages.rows().front().needed("lambda_1"), lambda, 1e-14 * lambda);
  EXPECT_EQ(std::ranges::count(stage_table(CartPole(), hanging).columns(), "lambda_1"), 0);
}

/// With an unknown, an integral, a free T, and a path constraint that reads a first-order state.
class Loaded final : public tests::SmallProblem {
 public:
  Loaded()
      : SmallProblem("loaded", at(0.0, 0.0, 0.0), at(1.0, 0.0, 1.0), 1.0, 1,
                     {{"mass", 2.0, "kg", "", 0.1, 10.0, false, true}}) {}
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"charge"}; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * varying("mass") * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return one(varying("mass") * x.y[0]);
  }
  [[nodiscard]] ExpressionVector integrands(const ControlledState& x) const override { return one(x.q[0]); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.path = Bounds::all(1, -3.0, 5.0);
    bounds.integrals = Bounds::all(1, 0.0, 40.0);
    bounds.horizon = {0.5, 2.0};
    return bounds;
  }
};

TEST(MotionTables, HaveConstantsTheirPricesAndBothBoundsOfPathConstraints) {
  const Loaded problem;
  const auto program = tests::transcribe(problem, {"dmoc", 2}, Grid::uniform(4));
  const auto rows = static_cast<Eigen::Index>(program->constraint_count());
  const Eigen::VectorXd start = sample(*program, guessed_motion(problem));
  const Trajectory motion = read_trajectory(*program, start, Eigen::VectorXd::Ones(rows));
  const Row node = node_table(problem, motion).rows().back();
  EXPECT_EQ(node.number("mass"), 2.0);
  EXPECT_EQ(node.number("price_mass"), motion.prices.unknowns[0]);
  EXPECT_EQ(node.number("integral_1"), motion.integrals[0]);
  EXPECT_EQ(node.number("price_integral_1"), motion.integral_prices[0]);
  EXPECT_EQ(node.number("price_horizon"), motion.prices.horizon);
  EXPECT_EQ(constraint_table(problem, motion).rows().back().number("h_1"), 2.0);  // mass times charge
  const Row constraint = quantity_table(problem).rows().back();
  EXPECT_EQ(constraint.number("lower"), -3.0);
  EXPECT_EQ(constraint.number("upper"), 5.0);
}

TEST(MotionTables, HaveNoPricesWhereNothingIsBounded) {
  const tests::DoubleIntegrator problem;
  const auto program = tests::transcribe(problem, {"dmoc", 2}, Grid::uniform(4));
  const auto rows = static_cast<Eigen::Index>(program->constraint_count());
  const Eigen::VectorXd start = sample(*program, guessed_motion(problem));
  const Trajectory motion = read_trajectory(*program, start, Eigen::VectorXd::Ones(rows));
  for (const Table& table : {node_table(problem, motion), stage_table(problem, motion)}) {
    for (const std::string& column : table.columns()) EXPECT_FALSE(column.starts_with("price_")) << column;
  }
}

}  // namespace
}  // namespace dmocbench
