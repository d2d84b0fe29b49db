#include <cmath>

#include <gtest/gtest.h>

#include "methods/extensions/primitives/solve_primitives.hpp"
#include "methods/extensions/primitives/stored_roadmap.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/hovercraft.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

/// The plane turned by an angle, then moved.
Displacement turn(double angle, double x, double y) {
  Displacement moved = Displacement::translation(Eigen::Vector3d(x, y, angle));
  moved.linear.topLeftCorner(2, 2) << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return moved;
}

/// A hovercraft that starts, glides and stops, each of them a primitive in other directions.
struct Glide {
  Hovercraft problem;
  PrimitiveLibrary library = PrimitiveLibrary::of(problem, 0.5, 4);
  std::vector<RoadmapNode> nodes;
  std::vector<RoadmapEdge> edges;

  Glide() {
    library.states = {BoundaryState::at_rest(Eigen::Vector3d::Zero()),
                      {.q = Eigen::Vector3d::Zero(), .v = Eigen::Vector3d(0.5, 0.1, 0.2)}};
    solve_primitives(problem,
                     {{.first = 0, .last = 1, .displacement = turn(0.7, 0.3, 0.2), .duration = 2},
                      {.first = 1, .last = 1, .displacement = turn(0.3, 0.5, 0.1), .duration = 2},
                      {.first = 1, .last = 0, .displacement = turn(-0.4, 0.6, -0.2), .duration = 3}},
                     library);
    nodes.push_back({.state = 0, .moved = turn(2.0, -1.0, 3.0)});
    for (std::size_t i = 0; i < library.primitives.size(); ++i) {
      const Primitive& primitive = library.primitives[i];
      nodes.push_back({.state = primitive.last, .moved = nodes.back().moved.after(primitive.displacement)});
      edges.push_back({.from = i, .to = i + 1, .primitive = i});
    }
  }
  [[nodiscard]] Roadmap roadmap() const { return {library, nodes, edges}; }
  [[nodiscard]] BoundaryState end(const RoadmapNode& node) const {
    return node.moved.state(library.states[node.state]);
  }
};

TEST(Concatenation, SatisfiesTheDiscreteEquationsOfTheWholeProblem) {
  const Glide glide;
  ASSERT_EQ(glide.library.primitives.size(), 3U);
  const Roadmap roadmap = glide.roadmap();
  const auto path = cheapest_path(roadmap, 0, 3, 7);
  ASSERT_TRUE(path);
  const Trajectory motion = concatenate(glide.problem, glide.library, roadmap, *path);
  Transcription program(glide.problem, *make_element("dmoc"), gauss_tableau(1), Grid::uniform(motion.intervals()));
  program.set_horizon(7 * glide.library.step);
  program.set_initial_state(glide.end(glide.nodes.front()));
  program.set_final_state(glide.end(glide.nodes.back()));
  const Eigen::VectorXd x = sample(program, smooth_motion(motion));
  Eigen::VectorXd rows(static_cast<Eigen::Index>(program.constraint_count()));
  program.constraints(x, rows);
  EXPECT_LT((rows - program.constraint_lower()).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_NEAR(program.objective(x) / program.cost_scale(), path->cost, 1e-12 * path->cost);
}

TEST(Concatenation, CostsWhatItsEdgesCost) {
  const Glide glide;
  const Roadmap roadmap = glide.roadmap();
  double sum = 0.0;
  for (const Primitive& primitive : glide.library.primitives) sum += primitive.cost;
  const Trajectory motion = concatenate(glide.problem, glide.library, roadmap, *cheapest_path(roadmap, 0, 3, 7));
  EXPECT_DOUBLE_EQ(motion.cost, sum);
  EXPECT_GT(sum, 0.0);
}

TEST(Concatenation, HasTheMomentaOfItsVelocities) {
  const Glide glide;
  const Roadmap roadmap = glide.roadmap();
  const Trajectory motion = concatenate(glide.problem, glide.library, roadmap, *cheapest_path(roadmap, 0, 3, 7));
  const Eigen::Vector3d mass(1.0, 1.0, 0.05);
  EXPECT_LT((motion.p - motion.v * mass.asDiagonal()).lpNorm<Eigen::Infinity>(), 1e-14);
}

TEST(Concatenation, RefusesAPathWithoutEdges) {
  const Glide glide;
  const Roadmap roadmap = glide.roadmap();
  tests::expect_error_naming({"at least one edge"},
                             [&] { static_cast<void>(concatenate(glide.problem, glide.library, roadmap, {})); });
}

TEST(SolvePrimitives, RefusesStatesThatDoNotExist) {
  Glide glide;
  tests::expect_error_naming({"2 states"}, [&] {
    solve_primitives(glide.problem, {{.first = 0, .last = 2, .displacement = Displacement::identity(3)}},
                     glide.library);
  });
}

TEST(PrimitiveLibrary, IsRefusedForOtherParametersAndProblems) {
  Glide glide;
  EXPECT_NO_THROW(glide.library.require_made_for(glide.problem));
  glide.problem.set_parameter("lever", 0.2);
  tests::expect_error_naming({"lever = 0.1", "lever = 0.2"}, [&] { glide.library.require_made_for(glide.problem); });
  glide.library.problem = "acrobot";
  tests::expect_error_naming({"acrobot", "hovercraft"}, [&] { glide.library.require_made_for(glide.problem); });
}

}  // namespace
}  // namespace dmocbench
