#include "bench/extensions/primitives/roadmap_file.hpp"

#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/extensions/primitives/planned_motion.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"
#include "problems/hovercraft.hpp"
#include "problems/orbital_transfer.hpp"
#include "problems/spherical_pendulum.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dmocbench {
namespace {

/// Two states and a primitive between them, which nobody has solved.
StoredRoadmap small_roadmap(const Problem& problem) {
  PrimitiveLibrary library = PrimitiveLibrary::of(problem, 0.1, 2);
  const Displacement moved = Displacement::translation(Eigen::Vector2d(0.0, 1.0 / 3.0));
  library.states = {BoundaryState::at_rest(Eigen::Vector2d(0.5, 0.0)),
                    BoundaryState::at_rest(Eigen::Vector2d(0.7, 0.0))};
  library.primitives = {{.first = 0,
                         .last = 1,
                         .displacement = moved,
                         .duration = 1,
                         .cost = 0.0,
                         .q = Eigen::MatrixXd::Random(3, 2),
                         .v = Eigen::MatrixXd::Random(3, 2),
                         .u = Eigen::MatrixXd::Random(2, 2)}};
  library.primitives[0].cost = 0.05 * 0.5 * library.primitives[0].u.squaredNorm();
  const Roadmap roadmap(library, {{.state = 0, .moved = Displacement::identity(2)}, {.state = 1, .moved = moved}},
                        {{.from = 0, .to = 1, .primitive = 0}});
  return {.library = library, .roadmap = roadmap, .start = 0, .goal = 1};
}

TEST(RoadmapFile, GivesBackEveryDigit) {
  const SphericalPendulum problem;
  const StoredRoadmap stored = small_roadmap(problem);
  const std::string text = roadmap_text(stored);
  const StoredRoadmap read = roadmap_of(text, problem);
  EXPECT_EQ(roadmap_text(read), text);
  EXPECT_EQ(read.library.primitives.front().q, stored.library.primitives.front().q);
  EXPECT_EQ(read.roadmap.nodes().back().moved.shift, stored.roadmap.nodes().back().moved.shift);
  EXPECT_EQ(read.goal, 1U);
}

TEST(RoadmapFile, IsRefusedWhereverItIsCutOff) {
  const SphericalPendulum problem;
  const std::string text = roadmap_text(small_roadmap(problem));
  for (std::size_t length = 0; length + 2 < text.size(); ++length) {
    EXPECT_THROW(static_cast<void>(roadmap_of(text.substr(0, length), problem)), Error) << length;
  }
}

TEST(RoadmapFile, IsRefusedWhereverADigitIsAnother) {
  const SphericalPendulum problem;
  const std::string text = roadmap_text(small_roadmap(problem));
  int digits = 0;
  for (std::size_t place = 0; place < text.size(); ++place) {
    if (text[place] < '0' || text[place] > '9') continue;
    std::string damaged = text;
    damaged[place] = static_cast<char>('0' + (text[place] - '0' + 5) % 10);
    EXPECT_THROW(static_cast<void>(roadmap_of(damaged, problem)), Error) << text.substr(place, 20);
    ++digits;
  }
  EXPECT_GT(digits, 100);
}

/// The roadmap with another value at a place of its content, and the checksum of that.
std::string doctored(const std::string& text, const std::string& place, const nlohmann::ordered_json& value) {
  auto json = nlohmann::ordered_json::parse(text);
  json["content"][nlohmann::ordered_json::json_pointer(place)] = value;
  json["crc32"] = checksum_of(json["content"].dump());
  return json.dump();
}

/// No value of another type is read as one, whatever the checksum says; the sentence names where it stands.
TEST(RoadmapFile, IsRefusedInASentenceWhereAValueIsOfAnotherType) {
  const SphericalPendulum problem;
  const std::string text = roadmap_text(small_roadmap(problem));
  const auto places = nlohmann::ordered_json::parse(text)["content"].flatten();
  for (const auto& [place, old] : places.items()) {
    for (const char* other : {"null", "true", "\"x\"", "[]", "{}", "[[1]]", "-1", "1e300", "4294967296"}) {
      const auto value = nlohmann::ordered_json::parse(other);
      const bool may_be = value.is_number() && old.is_number();  // of states and displacements any number is one
      try {
        static_cast<void>(roadmap_of(doctored(text, place, value), problem));
        EXPECT_TRUE(may_be) << place << " = " << other;
      } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find("json"), std::string::npos) << error.what();
      }
    }
  }
}

TEST(RoadmapFile, IsRefusedWhereACostOrTheStepIsNotThatOfItsMotions) {
  const SphericalPendulum problem;
  const std::string text = roadmap_text(small_roadmap(problem));
  for (const double number : {-7.0, -1e300, 0.0, 1e-12, 0.01, 1e12}) {
    for (const char* place : {"/primitives/0/cost", "/step"}) {
      EXPECT_THROW(static_cast<void>(roadmap_of(doctored(text, place, number), problem)), Error) << place << number;
    }
  }
}

class RoadmapFileInAFolder : public tests::InTemporaryFolder {};

TEST_F(RoadmapFileInAFolder, IsRefusedForAnotherProblemOrOtherParameters) {
  SphericalPendulum problem;
  const auto file = folder() / "roadmap.json";
  write_roadmap(file, small_roadmap(problem));
  EXPECT_NO_THROW(static_cast<void>(read_roadmap(file, problem)));
  const Hovercraft other;
  tests::expect_error_naming({"roadmap.json", "hovercraft"}, [&] { static_cast<void>(read_roadmap(file, other)); });
  problem.set_parameter("length", 2.0);
  tests::expect_error_naming({"roadmap.json", "length"}, [&] { static_cast<void>(read_roadmap(file, problem)); });
}

TEST(RoadmapFile, IsRefusedWhereItIsNoRoadmap) {
  const SphericalPendulum problem;
  for (const char* text : {"", "[]", "{}", "null", "7", R"({"format": "other", "version": 1})"}) {
    EXPECT_THROW(static_cast<void>(roadmap_of(text, problem)), Error) << text;
  }
}

TEST_F(RoadmapFileInAFolder, PlansTheSameAndLeadsToTheCertifiedOptimum) {
  const auto problem = std::make_shared<const OrbitalTransfer>();
  const RoadmapSystem& system = roadmap_system("orbital_transfer");
  const StoredRoadmap built = system.build(*problem, {});
  write_roadmap(folder() / "roadmap.json", built);
  const StoredRoadmap read = read_roadmap(folder() / "roadmap.json", *problem);
  const auto steps = static_cast<int>(std::lround(problem->horizon() / built.library.step));
  const auto path = cheapest_path(built.roadmap, built.start, built.goal, steps);
  ASSERT_TRUE(path);
  EXPECT_EQ(cheapest_path(read.roadmap, read.start, read.goal, steps)->edges, path->edges);
  const PlannedMotion planned =
      plan_and_refine(problem, system, {.stored = read, .seconds = 0.0, .is_read = true}, {.repeats = 1}, {});
  ASSERT_TRUE(planned.after) << planned.status;
  EXPECT_EQ(planned.before->cost, path->cost);
  const double optimum = problem->card().reference->objective;
  EXPECT_NEAR(planned.after->cost / optimum, 1.0, 1e-4);
  EXPECT_GT(planned.before->cost, optimum);
}

}  // namespace
}  // namespace dmocbench
