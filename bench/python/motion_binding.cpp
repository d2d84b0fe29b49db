#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bench/python/bindings.hpp"
#include "methods/error.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench::python {

namespace py = pybind11;

namespace {

/// Calls `use(name, member)` for every array of a trajectory; `std::invoke(member, trajectory)` is the array.
template <class Use>
void for_each_array(const Use& use) {
  use("t", &Trajectory::node_times);
  for (const TrajectoryTable& table : trajectory_tables) use(table.name, table.values);
  use("integrals", &Trajectory::integrals);
  use("integral_prices", &Trajectory::integral_prices);
  use("stage_t", &Trajectory::stage_times);
  use("values_of_unknowns", &Trajectory::unknowns);
  const auto price = [&use](const char* name, auto member) {
    use(name, [member](auto& trajectory) -> auto& { return trajectory.prices.*member; });
  };
  price("price_q", &BoundMultipliers::q);
  price("price_v", &BoundMultipliers::v);
  price("price_y", &BoundMultipliers::y);
  price("price_stage_v", &BoundMultipliers::stage_v);
  price("price_stage_u", &BoundMultipliers::stage_u);
  price("price_path", &BoundMultipliers::path);
  price("prices_of_unknowns", &BoundMultipliers::unknowns);
}

/// A view of an array that keeps the trajectory alive; None of an empty one.
template <class Values>
py::object view_of(const Values& values, const py::object& owner) {
  if (values.size() == 0) return py::none();
  const auto size = static_cast<py::ssize_t>(sizeof(double));
  py::array_t<double> view =
      Values::ColsAtCompileTime == 1
          ? py::array_t<double>({values.rows()}, {size}, values.data(), owner)
          : py::array_t<double>({values.rows(), values.cols()}, {size, size * values.rows()}, values.data(), owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

/// All that a trajectory consists of, for pickle.
py::tuple state_of(const Trajectory& trajectory) {
  py::dict arrays;
  for_each_array([&](const char* name, auto member) { arrays[name] = std::invoke(member, trajectory); });
  const Tableau& tableau = trajectory.tableau;
  return py::make_tuple(arrays, trajectory.cost, trajectory.prices.horizon, tableau.family, tableau.a,
                        tableau.a_conjugate, tableau.b, tableau.c, tableau.order, tableau.shares_controls);
}

std::unique_ptr<Trajectory> of_state(const py::tuple& state) {
  auto trajectory = std::make_unique<Trajectory>();
  const py::dict arrays = state[0];
  for_each_array([&](const char* name, auto member) {
    auto& array = std::invoke(member, *trajectory);
    array = arrays[name].template cast<std::remove_reference_t<decltype(array)>>();
  });
  trajectory->cost = state[1].cast<double>();
  trajectory->prices.horizon = state[2].cast<double>();
  trajectory->tableau = {.family = state[3].cast<std::string>(),
                         .a = state[4].cast<Eigen::MatrixXd>(),
                         .a_conjugate = state[5].cast<Eigen::MatrixXd>(),
                         .b = state[6].cast<Eigen::VectorXd>(),
                         .c = state[7].cast<Eigen::VectorXd>(),
                         .order = state[8].cast<int>(),
                         .shares_controls = state[9].cast<bool>()};
  return trajectory;
}

/// A trajectory through nodes, whose controls are linear between them. `t` begins at 0 and ascends; a row of each table
/// per node.
std::unique_ptr<Trajectory> of_nodes(const Eigen::VectorXd& t, const Eigen::MatrixXd& q, const Eigen::MatrixXd& v,
                                     const Eigen::MatrixXd& u, const Eigen::MatrixXd& y) {
  auto trajectory = std::make_unique<Trajectory>();
  trajectory->tableau = gauss_tableau(1);
  trajectory->node_times = t;
  trajectory->q = q;
  trajectory->v = v;
  trajectory->y = y;
  const Eigen::Index intervals = t.size() - 1;
  trajectory->stage_times = 0.5 * (t.head(intervals) + t.tail(intervals));
  trajectory->stage_u = 0.5 * (u.topRows(intervals) + u.bottomRows(intervals));
  return trajectory;
}

/// (q, v, u, y) of the smooth trajectory, a row for each time.
auto at(const Trajectory& trajectory, const Eigen::VectorXd& times) {
  const double end = trajectory.node_times[trajectory.intervals()];
  constexpr double rounding = 1e-12;
  for (const double t : times) {
    const bool is_inside = t >= -rounding * end && t <= (1.0 + rounding) * end;  // false of NaN
    if (!is_inside) throw Error("t = {:.6g} lies outside the horizon [0, {:.6g}]", t, end);
  }
  const Motion motion = smooth_motion(trajectory);
  const Eigen::Index n = trajectory.q.cols();
  Eigen::MatrixXd q(times.size(), n);
  Eigen::MatrixXd v(times.size(), n);
  Eigen::MatrixXd u(times.size(), trajectory.stage_u.cols());
  Eigen::MatrixXd y(times.size(), trajectory.y.cols());
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    const MotionPoint point = motion.at(times[i]);
    q.row(i) = point.q.transpose();
    v.row(i) = point.v.transpose();
    u.row(i) = point.u.transpose();
    y.row(i) = point.y.transpose();
  }
  return std::tuple(q, v, u, y);
}

}  // namespace

void bind_motion(py::module_& module) {
  py::class_<Trajectory> motion(module, "Motion", "The arrays of a discrete trajectory.");
  motion.def_static("of_nodes", &of_nodes, py::arg("t"), py::arg("q"), py::arg("v"), py::arg("u"), py::arg("y"));
  motion.def("at", &at, py::arg("times"), "(q, v, u, y) of the smooth trajectory, with a row for each time.");
  motion.def(py::pickle(&state_of, &of_state));
  for_each_array([&](const char* name, auto member) {
    motion.def_property_readonly(name, [member](const py::object& self) {
      return view_of(std::invoke(member, self.cast<const Trajectory&>()), self);
    });
  });
}

}  // namespace dmocbench::python
