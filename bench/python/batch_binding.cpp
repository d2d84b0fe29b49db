#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bench/python/bindings.hpp"
#include "bench/python/calls.hpp"
#include "methods/diagnostics/accuracy.hpp"
#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/batch/solve_batch.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/lane_transcription.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench::python {

namespace py = pybind11;

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The instances: a row of varied values for each; tables without rows mean the problem's values.
struct Instances {
  std::size_t count = 0;
  std::vector<std::string> parameters;  ///< names
  Rows values;                          ///< of the parameters
  Rows first;                           ///< (q, v) at 0
  Rows last;                            ///< (q, v) at T
};

/// Arrays of the answers, a row per instance.
struct Answers {
  Eigen::VectorXd cost;
  std::vector<std::string> status;
  std::vector<bool> is_solved;
  Eigen::VectorXi iterations;
  Rows q = {};  ///< node by node, if motions are requested
  Rows u = {};  ///< stage by stage
};

/// As long as nothing is solved. Without a limit of time that is over, all instances have their turn.
Answers no_answers(std::size_t instances) {
  const auto count = static_cast<Eigen::Index>(instances);
  return {.cost = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN()),
          .status = std::vector<std::string>(instances, std::string(name_of(Status::time_limit))),
          .is_solved = std::vector<bool>(instances, false),
          .iterations = Eigen::VectorXi::Zero(count)};
}

struct BatchAsked {
  std::string method = "dmoc";
  std::string tableau = "gauss";
  int stages = 1;
  long long intervals = 64;
  double tolerance = BatchOptions{}.tolerance;
  int most_iterations = BatchOptions{}.most_iterations;
  double most_seconds = 0.0;
  std::size_t threads = 0;
  bool motions = false;
};

void require_rows(const Rows& table, std::size_t count, Eigen::Index columns, const char* name) {
  if (table.rows() == 0) return;
  if (static_cast<std::size_t>(table.rows()) != count || table.cols() != columns) {
    throw Error("solve_batch: {} has shape ({}, {}), expected ({}, {})", name, table.rows(), table.cols(), count,
                columns);
  }
  if (!table.allFinite()) throw Error("solve_batch: {} has an entry that is not a finite number", name);
}

/// The work on one batch.
class Batch {
 public:
  Batch(const Problem& problem, const BatchAsked& asked, const Instances& instances)
      : problem_(problem),
        asked_(asked),
        instances_(instances),
        program_(problem, *make_element(asked.method), make_tableau(asked.tableau, asked.stages),
                 Grid::uniform(asked.intervals), OpenParameters{instances.parameters}),
        start_(sample(program_, guessed_motion(problem))) {
    const Eigen::Index n = problem.configuration_size();
    require_rows(instances.values, instances.count, std::ssize(instances.parameters), "parameters");
    require_rows(instances.first, instances.count, 2 * n, "start");
    require_rows(instances.last, instances.count, 2 * n, "end");
  }

  Answers solve(Call& call) {
    std::atomic<bool> is_stopped = false;
    BatchOptions options{.tolerance = asked_.tolerance, .most_iterations = asked_.most_iterations};
    options.threads = asked_.threads;
    options.stop_requested = [&, caller = std::this_thread::get_id()] {
      if (std::this_thread::get_id() == caller && call.is_interrupted()) is_stopped = true;
      return is_stopped.load();
    };
    const bool has_parameters = !instances_.parameters.empty();
    if (has_parameters) options.set_parameters = parameters_of(program_);
    // Instances with parameters of their own are prepared by the program, which a running batch needs itself.
    constexpr std::size_t most_prepared = 4096;
    const std::size_t step = has_parameters ? most_prepared : std::max<std::size_t>(instances_.count, 1);
    for (std::size_t first = 0; first < instances_.count && !is_stopped && !must_stop(); first += step) {
      solve_some(first, std::min(first + step, instances_.count), options);
    }
    return std::move(answers_);
  }

 private:
  void solve_some(std::size_t begin, std::size_t end, const BatchOptions& options) {
    std::vector<BatchInstance> prepared;
    if (!instances_.parameters.empty()) {
      for (std::size_t i = begin; i < end && !must_stop(); ++i) prepared.push_back(with_parameters(i));
      end = begin + prepared.size();
      program_.set_parameters(parameter_values(problem_));
    }
    ClampedEnds ends(program_);
    const auto next = [&](std::size_t index, BatchInstance& instance) {
      if (index >= end - begin) return false;
      if (instances_.parameters.empty()) {
        write(begin + index, ends, instance);
      } else {
        instance = prepared[index];
      }
      return true;
    };
    const auto take = [&](std::size_t index, const Solution& solution) { keep(begin + index, solution); };
    solve_batch(program_, lanes_of(program_), start_, next, take, options);
    read_motions();
  }

  [[nodiscard]] static BoundaryState state_of(const Rows& rows, std::size_t number, const BoundaryState& otherwise) {
    if (rows.rows() == 0) return otherwise;
    const Eigen::Index n = rows.cols() / 2;
    const auto row = rows.row(static_cast<Eigen::Index>(number));
    return {.q = row.head(n).transpose(), .v = row.tail(n).transpose()};
  }

  void write(std::size_t number, ClampedEnds& ends, BatchInstance& instance) const {
    instance.start = start_;
    instance.equality_values = program_.constraint_lower();
    if (instances_.first.rows() == 0 && instances_.last.rows() == 0) return;
    ends.write(state_of(instances_.first, number, first_), state_of(instances_.last, number, last_), instance.start,
               instance.equality_values);
  }

  /// Gives the program the values of an instance and returns its parameters.
  Eigen::VectorXd set_values(std::size_t number) {
    Eigen::VectorXd values = parameter_values(problem_);
    for (std::size_t i = 0; i < instances_.parameters.size(); ++i) {
      values[static_cast<Eigen::Index>(parameter_number(problem_, instances_.parameters[i]))] =
          instances_.values(static_cast<Eigen::Index>(number), static_cast<Eigen::Index>(i));
    }
    if (values.size() > 0) program_.set_parameters(values);
    if (instances_.first.rows() > 0) program_.set_initial_state(state_of(instances_.first, number, first_));
    if (instances_.last.rows() > 0) program_.set_final_state(state_of(instances_.last, number, last_));
    return values;
  }

  BatchInstance with_parameters(std::size_t number) {
    const Eigen::VectorXd values = set_values(number);
    BatchInstance instance;
    instance.start = sample(program_, guessed_motion(program_));
    const Eigen::VectorXd& rows = program_.constraint_lower();
    instance.equality_values = rows.array().isFinite().select(rows, 0.0);  // values of inequalities are not read
    instance.parameters = values;
    return instance;
  }

  void keep(std::size_t number, const Solution& solution) {
    write_answer(number, solution);
    if (asked_.motions || (is_solved(solution.status) && are_close(solution.primal))) {
      points_.emplace_back(number, solution.primal);
    }
  }

  void write_answer(std::size_t number, const Solution& solution) {
    const auto row = static_cast<Eigen::Index>(number);
    answers_.status[number] = name_of(solution.status);
    answers_.is_solved[number] = is_solved(solution.status);
    answers_.cost[row] = solution.objective / program_.cost_scale();
    answers_.iterations[row] = solution.major_iterations.value_or(0);
  }

  /// Whether the ends of an answer differ by so little that it may hide below the tolerance (`lost_distance`).
  [[nodiscard]] bool are_close(const Eigen::VectorXd& primal) const {
    const UnknownBlock& q = program_.blocks().unknown(Quantity::configuration);
    for (Eigen::Index i = 0; i < q.width; ++i) {
      const double first = primal[q.index(i)];
      const double last = primal[q.index(i) + asked_.intervals];
      if (is_small_distance(std::abs(last - first), std::max(std::abs(first), std::abs(last)))) return true;
    }
    return false;
  }

  /// The straight line between the ends of an instance, without round-off of a larger guess.
  [[nodiscard]] Motion straight_motion(std::size_t number) const {
    const BoundaryState first = state_of(instances_.first, number, first_);
    const BoundaryState last = state_of(instances_.last, number, last_);
    Motion motion = guessed_motion(program_);
    motion.at = [first, last, horizon = motion.horizon, guessed = motion.at](double t) {
      MotionPoint point = guessed(t);
      point.q = first.q + t / horizon * (last.q - first.q);
      point.v = (last.q - first.q) / horizon;
      point.u.setZero();
      return point;
    };
    return motion;
  }

  /// Solves an instance whose ends are close once more by itself: next to the guess of the problem, where a batch
  /// starts, its motion is round-off. Takes "solved" back from a solution that does not cover its distance.
  void solve_again(std::size_t number, Eigen::VectorXd& primal) {
    stop_if_requested();
    set_values(number);
    SolverOptions options;
    options.tolerance = asked_.tolerance;
    options.most_iterations = asked_.most_iterations;
    Solution alone = make_solver("interior_point", options)->solve(program_, sample(program_, straight_motion(number)));
    primal = alone.primal;
    if (is_solved(alone.status)) {
      const Trajectory motion = read_trajectory(program_, primal, Eigen::VectorXd());
      const Accuracy found = accuracy(program_.traced_problem(), motion);
      if (!lost_distance(program_.bounds(), motion, found).empty()) alone.status = Status::not_confirmed;
    }
    write_answer(number, alone);
  }

  void read_motions() {
    for (auto& [number, primal] : points_) {
      if (primal.size() == 0 || !primal.allFinite()) continue;
      if (answers_.is_solved[number] && are_close(primal)) {
        try {
          solve_again(number, primal);
        } catch (const Stopped&) {  // whether it covers its distance is unknown
          answers_.status[number] = name_of(Status::time_limit);
          answers_.is_solved[number] = false;
        }
      }
      if (!asked_.motions) continue;
      set_values(number);
      const Trajectory motion = read_trajectory(program_, primal, Eigen::VectorXd());
      keep_motion(number, motion.q, answers_.q);
      keep_motion(number, motion.stage_u, answers_.u);
    }
    points_.clear();
  }

  void keep_motion(std::size_t number, const Rows& values, Rows& table) const {
    const double none = std::numeric_limits<double>::quiet_NaN();
    if (table.size() == 0) table = Rows::Constant(static_cast<Eigen::Index>(instances_.count), values.size(), none);
    table.row(static_cast<Eigen::Index>(number)) = values.reshaped<Eigen::RowMajor>().transpose();
  }

  const Problem& problem_;
  const BatchAsked& asked_;
  const Instances& instances_;
  Transcription program_;
  Eigen::VectorXd start_;
  BoundaryState first_ = problem_.initial_state();
  BoundaryState last_ = problem_.final_state();
  Answers answers_ = no_answers(instances_.count);
  std::vector<std::pair<std::size_t, Eigen::VectorXd>> points_;  // of instances whose motions are still to be read
};

}  // namespace

void bind_batch(py::module_& module) {
  py::class_<BatchAsked>(module, "BatchAsked")
      .def(py::init<>())
      .def_readwrite("method", &BatchAsked::method)
      .def_readwrite("tableau", &BatchAsked::tableau)
      .def_readwrite("stages", &BatchAsked::stages)
      .def_readwrite("intervals", &BatchAsked::intervals)
      .def_readwrite("tolerance", &BatchAsked::tolerance)
      .def_readwrite("most_iterations", &BatchAsked::most_iterations)
      .def_readwrite("most_seconds", &BatchAsked::most_seconds)
      .def_readwrite("threads", &BatchAsked::threads)
      .def_readwrite("motions", &BatchAsked::motions);
  module.def(
      "solve_batch",
      [](const ProblemHandle& handle, const BatchAsked& asked, std::size_t count,
         const std::vector<std::string>& parameters, const Rows& values, const Rows& first, const Rows& last) {
        const Instances instances{count, parameters, values, first, last};
        Answers answers = without_gil([&](Call& call) {
          const StopScope scope([&call] { return call.is_interrupted(); }, asked.most_seconds);
          try {
            return Batch(*handle.problem, asked, instances).solve(call);
          } catch (const Stopped&) {  // while it was set up
            return no_answers(count);
          }
        });
        py::dict result;
        result["cost"] = std::move(answers.cost);
        result["status"] = std::move(answers.status);
        result["is_solved"] = std::move(answers.is_solved);
        result["iterations"] = std::move(answers.iterations);
        result["q"] = std::move(answers.q);
        result["u"] = std::move(answers.u);
        return result;
      },
      py::arg("problem"), py::arg("asked"), py::arg("count"), py::arg("parameters"), py::arg("values"),
      py::arg("first"), py::arg("last"));
}

}  // namespace dmocbench::python
