#include "bench/extensions/primitives/roadmap_picture.hpp"

#include <cstddef>

#include <fmt/format.h>

#include "methods/mechanics/point_function.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

namespace {

/// The two quantities of the plane. Of a single q on a lattice its velocity is the second.
Picture plane_of(const Problem& problem, bool shows_configurations, const ControlledState& x) {
  if (!shows_configurations) {
    const Picture all = pictured_quantities(problem, x);
    return {all.at(0), all.at(1)};
  }
  const std::vector<std::string> names = problem.configuration_names();
  if (names.size() > 1) return {{names[0], "", x.q[0]}, {names[1], "", x.q[1]}};
  return {{names[0], "", x.q[0]}, {"velocity of " + names[0], "", x.v[0]}};
}

std::string with_unit(const PictureQuantity& quantity) {
  return quantity.unit.empty() ? quantity.name : fmt::format("{} [{}]", quantity.name, quantity.unit);
}

/// The positions of states in the plane.
class PicturePlane {
 public:
  PicturePlane(const Problem& problem, bool shows_configurations)
      : name_(problem.name()),
        function_(problem.configuration_size(), problem.control_size(), [&](const ControlledState& x) {
          const Picture plane = plane_of(problem, shows_configurations, x);
          return ExpressionVector{{plane[0].value, plane[1].value}};
        }) {}

  [[nodiscard]] PicturePoint at(const std::string& part, const BoundaryState& state, std::optional<double> t,
                                std::optional<double> u) {
    Eigen::VectorXd place(2);
    function_.evaluate(state.q, state.v, Eigen::VectorXd(), 0.0, place);
    return {.problem = name_, .part = part, .t = t, .x = place[0], .y = place[1], .u = u};
  }

 private:
  std::string name_;
  PointFunction function_;
};

void add_motion(const Trajectory& motion, const std::string& part, double time_unit, PicturePlane& plane,
                std::vector<PicturePoint>& points) {
  for (Eigen::Index k = 0; k <= motion.intervals(); ++k) {
    const MotionPoint node = motion.node(k);
    const double t = motion.node_times[k];
    points.push_back(plane.at(part, {node.q, node.v}, t * time_unit, control_at(motion, t)[0]));
  }
}

}  // namespace

Columns<PicturePoint> picture_columns() {
  return {{"problem", "", "name of the problem", &PicturePoint::problem},
          {"part", "", "node of the roadmap, joint of the path, or the motion before or after the full solve",
           &PicturePoint::part},
          {"t", "", "time in the problem's unit; empty for nodes", &PicturePoint::t},
          {"x", "", "first quantity of the problem's picture, or q_1 where states lie on a lattice", &PicturePoint::x},
          {"y", "", "second quantity, or q_2, or the velocity of a single q", &PicturePoint::y},
          {"u", "", "first control; empty for nodes", &PicturePoint::u}};
}

PictureAxes picture_axes(const PlannedMotion& planned) {
  const Problem& problem = *planned.problem;
  InputCounter counter;
  const ExpressionVector q = counter.take(problem.configuration_size());
  const ExpressionVector v = counter.take(problem.configuration_size());
  const ExpressionVector u = counter.take(problem.control_size());
  const Picture plane = plane_of(problem, planned.system->shows_configurations, {q, v, u, counter.take()});
  return {.x = with_unit(plane[0]), .y = with_unit(plane[1])};
}

std::vector<PicturePoint> picture_of(const PlannedMotion& planned) {
  const auto& [library, roadmap, start, goal] = planned.roadmap.stored;
  PicturePlane plane(*planned.problem, planned.system->shows_configurations);
  std::vector<PicturePoint> points;
  const auto state_of = [&](std::size_t node) {
    const RoadmapNode& at = roadmap.nodes()[node];
    return at.moved.state(library.states[at.state]);
  };
  constexpr std::size_t most_nodes = 1500;
  const std::size_t stride = 1 + roadmap.nodes().size() / most_nodes;
  for (std::size_t node = 0; node < roadmap.nodes().size(); node += stride) {
    points.push_back(plane.at("node", state_of(node), {}, {}));
  }
  if (!planned.path) return points;
  const double time_unit = planned.problem->card().time_unit.factor;
  points.push_back(plane.at("joint", state_of(start), {}, {}));
  for (const std::size_t edge : planned.path->edges) {
    points.push_back(plane.at("joint", state_of(roadmap.edges()[edge].to), {}, {}));
  }
  if (planned.before) add_motion(*planned.before, "before", time_unit, plane, points);
  if (planned.after) add_motion(*planned.after, "after", time_unit, plane, points);
  return points;
}

}  // namespace dmocbench
