#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bench/experiments/solve/wanted_accuracy.hpp"
#include "bench/python/bindings.hpp"
#include "bench/python/calls.hpp"
#include "bench/run/advice.hpp"
#include "bench/run/solve_case.hpp"
#include "methods/adaptive/adaptive_solve.hpp"
#include "methods/adaptive/error_estimate.hpp"
#include "methods/error.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/iteration_scope.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/tables/motion_file.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/phase_trajectories.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench::python {

namespace py = pybind11;

namespace {

/// The solve that Python requests.
struct Asked {
  std::string method = "dmoc";
  std::string tableau = "gauss";
  int stages = 1;
  long long intervals = 128;
  Eigen::VectorXd nodes;  ///< relative times; none for a uniform grid
  std::string solver = "auto";
  std::string derivatives = "tape";
  std::string form = "bolza";
  double tolerance = SolverOptions{}.tolerance;
  int most_iterations = SolverOptions{}.most_iterations;
  double most_seconds = 0.0;
  bool verbose = false;
  NamedOptions options;
  std::optional<double> accuracy;
  std::string refinement = "h";
};

/// An answer, with further results computed on first use.
struct Answer {
  SolvedCase solved;
  std::optional<IndependentChecks> checks;
};

/// A trajectory to start from, moved to the ends of the problem. Throws `Error` if it is not of a problem like this
/// one.
Start start_from(const Trajectory& trajectory, const Problem& problem) {
  const bool fits = trajectory.q.cols() == problem.configuration_size() &&
                    trajectory.stage_u.cols() == problem.control_size() &&
                    trajectory.y.cols() == problem.first_order_size();
  if (!fits) {
    throw Error("start= has {} coordinates, {} controls and {} first-order states, but the problem has {}, {} and {}",
                trajectory.q.cols(), trajectory.stage_u.cols(), trajectory.y.cols(), problem.configuration_size(),
                problem.control_size(), problem.first_order_size());
  }
  Start start{.motion = moved_to_ends(smooth_motion(trajectory), problem.bounds())};
  if (trajectory.has_costates()) start.with_costates = trajectory;
  return start;
}

Case case_of(const ProblemHandle& handle, const Asked& asked) {
  return {.problem = handle.problem,
          .method = asked.method,
          .tableau = asked.tableau,
          .stages = asked.stages,
          .solver = asked.solver,
          .derivatives = asked.derivatives,
          .grid = asked.nodes.size() > 0 ? Grid::from_nodes(asked.nodes) : Grid::uniform(asked.intervals),
          .form = cost_form_named(asked.form)};
}

/// Reports a running solve to Python, which may end it.
class Watch {
 public:
  /// `callback`: None, or called for every iteration; a true value ends the solve. `prints_grids`: a line for each.
  Watch(Call& call, const py::object& callback, double cost_scale, bool prints_grids)
      : call_(call), callback_(callback), cost_scale_(cost_scale), prints_grids_(prints_grids) {}

  [[nodiscard]] bool wants_iterations() const { return !callback_.is_none(); }
  [[nodiscard]] bool must_stop() const { return is_over_ || call_.is_interrupted(); }
  /// Whether the callback has ended the solve.
  [[nodiscard]] bool has_ended() const { return is_over_; }

  void operator()(const Iteration& iteration) {
    in_python([&] {
      const py::object answer =
          callback_(std::string(iteration.solver), iteration.number, iteration.objective / cost_scale_,
                    iteration.violation, iteration.stationarity);
      is_over_ = is_over_ || py::bool_(answer);
    });
  }

  void operator()(const GridAttempt& grid) {
    if (!prints_grids_) return;
    std::fflush(stdout);  // what the solver has printed comes before
    in_python([&] {
      const std::string error = is_solved(grid.status) ? fmt::format("estimated error {:.1e}", grid.relative)
                                                       : std::string(name_of(grid.status));
      py::print(fmt::format("grid of {}, {}: {}, {}, {:.2g} s", counted(grid.intervals, "interval"),
                            counted(grid.stages, "stage"), error, counted(grid.iterations, "iteration"), grid.seconds),
                py::arg("flush") = true);
    });
  }

 private:
  /// An exception ends the solve and is raised afterwards: it does not pass through solvers.
  template <class Work>
  void in_python(const Work& work) {
    if (is_over_) return;
    const py::gil_scoped_acquire gil;
    try {
      work();
    } catch (py::error_already_set& error) {
      Call::keep(error);
      call_.raise_later();
      is_over_ = true;
    }
  }

  Call& call_;
  const py::object& callback_;
  double cost_scale_;
  bool prints_grids_;
  bool is_over_ = false;
};

SolverOptions solver_options(const Asked& asked, const Watch& watch) {
  SolverOptions options;
  options.tolerance = asked.tolerance;
  options.most_iterations = asked.most_iterations;
  options.most_seconds = asked.most_seconds;
  options.verbose = asked.verbose;
  options.stop_requested = [&watch] { return watch.must_stop(); };
  return options;
}

/// On grids that are refined until the estimated error is small enough.
SolvedCase solve_on_grids(const Case& the_case, const Start& start, const Asked& asked, const SolverOptions& options,
                          Watch& watch) {
  AdaptiveOptions adaptive;
  adaptive.accuracy = asked.accuracy.value_or(adaptive.accuracy);
  adaptive.refinement = refinement_named(asked.refinement);
  adaptive.solver = asked.solver;
  adaptive.solver_options = options;
  adaptive.named_options = asked.options;
  if (the_case.form != CostForm::bolza || the_case.derivatives != "tape") {
    throw Error(R"(accuracy= refines with form="bolza" and derivatives="tape")");
  }
  return solve_accurately(the_case, start, adaptive, std::ref(watch));
}

/// After the end by a callback, which stops the reading of the trajectory too.
void read_last_iterate(SolvedCase& solved) {
  const Solution& solution = solved.solution;
  if (solved.trajectory || !solved.program || solution.primal.size() == 0 || !solution.primal.allFinite()) return;
  try {
    solved.trajectory = read_trajectory(*solved.program, solution.primal, solution.multipliers);
  } catch (const Error&) {  // there is none through this point, as where its momenta are not defined
    return;
  }
}

std::unique_ptr<Answer> solve(const ProblemHandle& handle, const Asked& asked, const Trajectory* from,
                              const py::object& callback) {
  return without_gil([&](Call& call) {
    const Problem& problem = *handle.problem;
    const Case the_case = case_of(handle, asked);
    Watch watch(call, callback, problem.cost_scale(), asked.verbose);
    const SolverOptions options = solver_options(asked, watch);
    const auto solver = make_solver(asked.solver, options, asked.options);
    auto answer = std::make_unique<Answer>();
    {
      const StopScope scope(options.stop_requested, 0.0);
      const IterationScope watched(watch.wants_iterations() ? std::function<void(const Iteration&)>(std::ref(watch))
                                                            : nullptr);
      const Start start = from == nullptr ? Start{.motion = guessed_motion(problem)} : start_from(*from, problem);
      answer->solved = asked.accuracy ? solve_on_grids(the_case, start, asked, options, watch)
                                      : solve_case(the_case, start, *solver, asked.tolerance, 1);
    }
    if (watch.has_ended() && !asked.accuracy) answer->solved.solution.message = sentence_of(Status::interrupted);
    if (watch.has_ended()) read_last_iterate(answer->solved);
    return answer;
  });
}

const IndependentChecks& checks_of(Answer& answer) {
  if (!answer.checks) {
    answer.checks = without_gil([&](Call& call) {
      const StopScope scope([&call] { return call.is_interrupted(); }, 0.0);
      return check_independently(answer.solved);
    });
  }
  return *answer.checks;
}

double estimated_error(Answer& answer) {
  SolvedCase& solved = answer.solved;
  if (!solved.estimated_error) {
    solved.estimated_error = without_gil([&](Call& call) {
      const Status status = solved.solution.status;
      const bool is_optimum = is_solved(status) || is_no_motion(status);  // of the discrete program
      if (!is_optimum || !solved.trajectory) throw Error("the program of this solution is not solved");
      if (!solved.trajectory->has_costates()) throw Error("the solution has no costates");
      const StopScope scope([&call] { return call.is_interrupted(); }, 0.0);
      ErrorEstimator estimator(*solved.program);
      return estimator
          .estimate(*solved.program, solved.solution.primal, solved.solution.multipliers, *solved.trajectory)
          .relative;
    });
  }
  return *solved.estimated_error;
}

/// The arrays of every phase by its name, in the time of the whole motion; none where the problem has no phases.
py::dict phases_of(const Answer& answer) {
  py::dict phases;
  const PhasedProblem* const problem = answer.solved.the_case.problem->phased();
  if (problem == nullptr || !answer.solved.trajectory) return phases;
  const std::vector<PhaseTrajectory> parts = phase_trajectories(*problem, *answer.solved.trajectory);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto& [start, motion] = parts[i];
    const Problem& phase = *problem->phases()[i].problem;
    phases[py::str(problem->phases()[i].name)] = py::dict(
        py::arg("t") = Eigen::VectorXd(motion.node_times.array() + start), py::arg("q") = motion.q,
        py::arg("v") = motion.v, py::arg("p") = motion.p, py::arg("psi_q") = motion.psi_q,
        py::arg("psi_p") = motion.psi_p, py::arg("y") = motion.y, py::arg("psi_y") = motion.psi_y,
        py::arg("stages_t") = Eigen::VectorXd(motion.stage_times.array() + start), py::arg("u") = motion.stage_u,
        py::arg("coordinates") = phase.configuration_names(), py::arg("controls") = phase.control_names(),
        py::arg("first_order_states") = phase.first_order_names());
  }
  return phases;
}

void bind_options(py::module_& module) {
  py::class_<Asked>(module, "Asked")
      .def(py::init<>())
      .def_readwrite("method", &Asked::method)
      .def_readwrite("tableau", &Asked::tableau)
      .def_readwrite("stages", &Asked::stages)
      .def_readwrite("intervals", &Asked::intervals)
      .def_readwrite("nodes", &Asked::nodes)
      .def_readwrite("solver", &Asked::solver)
      .def_readwrite("derivatives", &Asked::derivatives)
      .def_readwrite("form", &Asked::form)
      .def_readwrite("tolerance", &Asked::tolerance)
      .def_readwrite("most_iterations", &Asked::most_iterations)
      .def_readwrite("most_seconds", &Asked::most_seconds)
      .def_readwrite("verbose", &Asked::verbose)
      .def_readwrite("options", &Asked::options)
      .def_readwrite("accuracy", &Asked::accuracy)
      .def_readwrite("refinement", &Asked::refinement);
}

/// Values of the unknown parameters by their names; none where the motion has no values.
std::map<std::string, double> by_unknown(const SolvedCase& solved, const Eigen::VectorXd& values) {
  std::map<std::string, double> named;
  const Problem& problem = *solved.the_case.problem;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    named[problem.parameters()[problem.unknowns()[static_cast<std::size_t>(i)]].name] = values[i];
  }
  return named;
}

void bind_numbers(py::class_<Answer>& answer) {
  const auto number = [&](const char* name, auto read) {
    answer.def_property_readonly(name, [read](const Answer& one) { return read(one.solved); });
  };
  number("problem", [](const SolvedCase& solved) { return solved.the_case.problem->name(); });
  number("method", [](const SolvedCase& solved) { return solved.the_case.method; });
  number("tableau", [](const SolvedCase& solved) { return solved.the_case.tableau; });
  number("stage_count", [](const SolvedCase& solved) { return solved.the_case.stages; });
  number("intervals", [](const SolvedCase& solved) { return solved.the_case.intervals(); });
  number("solver", [](const SolvedCase& solved) { return solved.solution.solver; });
  number("status", [](const SolvedCase& solved) { return std::string(name_of(solved.solution.status)); });
  number("message", [](const SolvedCase& solved) { return solved.solution.message; });
  number("is_solved", [](const SolvedCase& solved) { return is_solved(solved.solution.status); });
  number("cost", [](const SolvedCase& solved) {
    return solved.trajectory ? std::optional(solved.trajectory->cost) : std::nullopt;
  });
  number("iterations", [](const SolvedCase& solved) { return solved.solution.major_iterations; });
  number("kkt_residual", [](const SolvedCase& solved) { return solved.solution.kkt_residual; });
  number("constraint_violation", [](const SolvedCase& solved) { return solved.solution.constraint_violation; });
  number("seconds", [](const SolvedCase& solved) { return solved.solution.seconds; });
  number("setup_seconds", [](const SolvedCase& solved) { return solved.setup_seconds; });
  number("relative_jump", [](const SolvedCase& solved) {
    return solved.accuracy ? std::optional(solved.accuracy->relative_jump) : std::nullopt;
  });
  number("coordinates", [](const SolvedCase& solved) { return solved.the_case.problem->configuration_names(); });
  number("controls", [](const SolvedCase& solved) { return solved.the_case.problem->control_names(); });
  number("coordinate_units",
         [](const SolvedCase& solved) { return solved.the_case.problem->card().configuration_units; });
  number("control_units", [](const SolvedCase& solved) { return solved.the_case.problem->card().control_units; });
  number("time_unit", [](const SolvedCase& solved) {
    const Unit unit = solved.the_case.problem->card().time_unit;
    return unit.factor == 1.0 ? unit.name : std::string();  // times are as solved
  });
  number("first_order_states", [](const SolvedCase& solved) { return solved.the_case.problem->first_order_names(); });
  number("unknowns", [](const SolvedCase& solved) {
    return by_unknown(solved, solved.trajectory ? solved.trajectory->unknowns : Eigen::VectorXd());
  });
  number("price_unknowns", [](const SolvedCase& solved) {
    return by_unknown(solved, solved.trajectory ? solved.trajectory->prices.unknowns : Eigen::VectorXd());
  });
  number("price_horizon", [](const SolvedCase& solved) {
    const bool has_price = solved.trajectory && solved.trajectory->has_costates();
    return has_price ? std::optional(solved.trajectory->prices.horizon) : std::nullopt;
  });
}

/// The quantities of the problem's picture at the nodes: (columns, a row per node); empty without a trajectory.
std::pair<std::vector<std::string>, Eigen::MatrixXd> picture_of(const Answer& answer) {
  const std::optional<Trajectory>& motion = answer.solved.trajectory;
  if (!motion) return {};
  const Table table = picture_table(*answer.solved.the_case.problem, *motion);
  const std::vector<std::string>& columns = table.columns();
  Eigen::MatrixXd values(std::ssize(table.rows()), std::ssize(columns));
  for (std::size_t i = 0; i < table.rows().size(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          table.rows()[i].number(columns[j], std::nan(""));
    }
  }
  return {columns, values};
}

}  // namespace

void bind_solve(py::module_& module) {
  bind_options(module);
  py::class_<Answer> answer(module, "Answer");
  bind_numbers(answer);
  answer.def_property_readonly("motion", [](const py::object& self) -> py::object {
    const std::optional<Trajectory>& motion = self.cast<const Answer&>().solved.trajectory;
    return motion ? py::cast(*motion, py::return_value_policy::reference_internal, self) : py::none();
  });
  answer.def_property_readonly("picture", &picture_of);
  answer.def_property_readonly("replay_error", [](Answer& one) {
    const IndependentChecks& checks = checks_of(one);
    return checks.replay ? std::optional(checks.replay->norm()) : std::nullopt;
  });
  answer.def_property_readonly("replay_in_words", [](Answer& one) {
    const IndependentChecks& checks = checks_of(one);
    return checks.replay ? replay_in_words(*one.solved.the_case.problem, *checks.replay) : "none";
  });
  answer.def_property_readonly("advice", [](Answer& one) {
    Advice advice = next_to_try(one.solved, "");
    if (advice.remedy == Remedy::none) advice = doubt_about_units(*one.solved.the_case.problem);
    if (advice.remedy == Remedy::none) advice = doubt_about_replay(one.solved, checks_of(one).replay);
    return py::dict(py::arg("remedy") = name_of(advice.remedy), py::arg("coordinate") = advice.coordinate,
                    py::arg("size") = advice.size, py::arg("smallest") = advice.smallest,
                    py::arg("smallest_size") = advice.smallest_size);
  });
  answer.def_property_readonly("largest_violation", [](Answer& one) { return checks_of(one).violation_between_nodes; });
  answer.def("estimated_error", &estimated_error);
  answer.def_property_readonly("phases", &phases_of);
  module.def("solve", &solve, py::arg("problem"), py::arg("asked"), py::arg("start"), py::arg("callback"));
  module.def("methods", &all_methods, "Names of all methods.");
  module.def("solvers", &solver_names, "Names of all solvers.");
}

}  // namespace dmocbench::python
