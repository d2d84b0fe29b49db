#include "methods/tables/motion_file.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/tables/table.hpp"
#include "methods/transcription/motions/phase_trajectories.hpp"

namespace dmocbench {

namespace {

std::string fault_of_field(const Table& table, const Row& row, const std::string& column) {
  if (std::ranges::count(table.columns(), column) == 0)
    return fmt::format("there is no column {}; the columns are {}", column, fmt::join(table.columns(), ", "));
  return fmt::format("\"{}\" in column {} is not a number", row.text(column), column);
}

/// The columns PREFIX NAME of the table in a file.
Eigen::MatrixXd columns(const Table& table, const std::vector<std::string>& names, const std::string& prefix,
                        const std::filesystem::path& file) {
  Eigen::MatrixXd values(std::ssize(table.rows()), std::ssize(names));
  for (Eigen::Index k = 0; const Row& row : table.rows()) {
    for (Eigen::Index i = 0; const std::string& name : names) {
      const auto value = row.number(prefix + name);
      if (!value) throw Error("{}: {}", file.string(), fault_of_field(table, row, prefix + name));
      values(k, i++) = *value;
    }
    ++k;
  }
  return values;
}

/// Reads ψ^q, ψ^p and ψ^y; a table without columns or fields of them is a motion all the same.
void read_costates(const Problem& problem, const Table& nodes, const std::filesystem::path& file,
                   Trajectory& trajectory) {
  const std::vector<std::string> names = problem.configuration_names();
  const auto has_field = [&](const Row& row) {
    return std::ranges::any_of(names, [&](const std::string& name) {
      return !row.text("psi_q_" + name).empty() || !row.text("psi_p_" + name).empty();
    });
  };
  if (std::ranges::none_of(nodes.rows(), has_field)) return;
  trajectory.psi_q = columns(nodes, names, "psi_q_", file);
  trajectory.psi_p = columns(nodes, names, "psi_p_", file);
  trajectory.psi_y = columns(nodes, problem.first_order_names(), "psi_", file);
}

/// The column t. Throws `Error` unless it ascends.
Eigen::VectorXd times_in(const Table& table, const std::filesystem::path& file) {
  Eigen::VectorXd times = columns(table, {"t"}, "", file);
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    if (std::isfinite(times[k]) && (k == 0 || times[k] > times[k - 1])) continue;
    throw Error("{}: t must be finite and increasing, but is not in row {}", file.string(), k + 1);
  }
  return times;
}

/// Quantities over time: a column each, with a prefix before its name; no rows where there are none.
struct Series {
  std::string prefix;
  std::vector<std::string> names;
  Eigen::MatrixXd values;
  std::string meaning;
  std::vector<std::string> units = {};  ///< of each; empty for the problem's own units
};

Table series_table(const std::string& time, const Eigen::VectorXd& times, const std::vector<Series>& all,
                   const std::string& time_unit = "") {
  std::vector<std::string> header{time};
  std::vector<Row> rows(static_cast<std::size_t>(times.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].set(time, times[static_cast<Eigen::Index>(k)]);
  constexpr FieldType number{FieldKind::number, true};
  std::map<std::string, ColumnFacts> facts{{time, {time_unit, "time", number}}};
  for (const auto& [prefix, names, values, meaning, units] : all) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      header.push_back(prefix + names[i]);
      facts[header.back()] = {units.empty() ? "" : units[i], meaning, number};
      for (Eigen::Index k = 0; k < values.rows(); ++k) {
        rows[static_cast<std::size_t>(k)].set(header.back(), values(k, static_cast<Eigen::Index>(i)));
      }
    }
  }
  Table table(header);
  table.describe(facts);
  for (Row& row : rows) table.append(std::move(row));
  return table;
}

/// The controls of a table that has them next to q and v; for missing columns the guess's controls at the same share of
/// the horizon.
Eigen::MatrixXd controls_at_nodes(const Problem& problem, const Table& nodes, const Eigen::VectorXd& times,
                                  const std::filesystem::path& file) {
  const std::vector<std::string> names = problem.control_names();
  const auto has_column = [&](const std::string& name) { return std::ranges::count(nodes.columns(), name) > 0; };
  if (std::ranges::any_of(names, has_column)) return columns(nodes, names, "", file);
  Eigen::MatrixXd controls(times.size(), problem.control_size());
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    controls.row(k) = problem.guess(problem.horizon() * times[k] / times[times.size() - 1]).u.transpose();
  }
  return controls;
}

/// Throws `Error` unless the stages lie in the intervals of the nodes from the first to the last: a file may have been
/// cut, or be another motion's.
void require_one_motion(const Trajectory& motion, const std::filesystem::path& nodes,
                        const std::filesystem::path& stages) {
  const Eigen::Index last = motion.node_times.size() - 1;
  const double first_stage = motion.stage_times[0];
  const double last_stage = motion.stage_times[motion.stage_times.size() - 1];
  const double rounding = 1e-9 * motion.node_times[last];
  if (first_stage >= -rounding && first_stage <= motion.node_times[1] + rounding &&
      last_stage >= motion.node_times[last - 1] - rounding && last_stage <= motion.node_times[last] + rounding) {
    return;
  }
  throw Error(
      "{} has stages from t = {:g} to {:g}, but the nodes in {} extend from 0 to {:g}: they belong to "
      "different trajectories, or one of the files is truncated",
      stages.string(), first_stage, last_stage, nodes.filename().string(), motion.node_times[last]);
}

/// Throws `Error` if a motion lasts so much longer or shorter than the problem's that its times must be in another
/// unit.
void require_similar_horizon(const Problem& problem, double horizon, const std::filesystem::path& nodes) {
  constexpr double most = 10.0;
  if (horizon <= most * problem.horizon() && most * horizon >= problem.horizon()) return;
  throw Error("{}: the trajectory lasts {:g}, but {} lasts {:g}; a start can be stretched by a factor of at most {:g}",
              nodes.string(), horizon, problem.name(), problem.horizon(), most);
}

std::vector<std::string> unknown_names(const Problem& problem) {
  std::vector<std::string> names;
  for (const std::size_t unknown : problem.unknowns()) names.push_back(problem.parameters()[unknown].name);
  return names;
}

/// Reads the unknown parameters; a table without columns of them is a motion all the same.
void read_unknowns(const Problem& problem, const Table& nodes, const std::filesystem::path& file,
                   Trajectory& trajectory) {
  const std::vector<std::string> names = unknown_names(problem);
  const Row& first = nodes.rows().front();
  if (names.empty() || std::ranges::any_of(names, [&](const std::string& name) { return first.text(name).empty(); }))
    return;
  trajectory.unknowns = columns(nodes, names, "", file).row(0).transpose();
}

std::vector<std::string> constraint_names(const Problem& problem, Eigen::Index count) {
  std::vector<std::string> names = problem.card().path_constraint_names;
  while (std::ssize(names) < count) names.push_back(fmt::format("h_{}", names.size() + 1));
  names.resize(static_cast<std::size_t>(count));
  return names;
}

/// The path constraints as a function of a point.
PointFunction path_function(const Problem& problem) {
  return {problem.configuration_size(), problem.control_size(),
          [&](const ControlledState& x) { return problem.path_constraints(x); }, problem.first_order_size()};
}

/// Prices of the bounds of these quantities; no columns where they have none.
Series priced(const std::string& prefix, const std::vector<std::string>& names, const Eigen::MatrixXd& prices,
              const std::string& of) {
  return {prefix, prices.size() > 0 ? names : std::vector<std::string>(), prices,
          "increase of the optimal cost per unit of the bound on " + of};
}

/// λ at the stages, whatever the method; without columns where there are none, or the equations of motion are singular.
Series multipliers_at_stages(const Problem& problem, const Trajectory& trajectory) {
  Series series{"lambda_", {}, {}, "multiplier of a constraint g(q) = 0 (energy per unit of g) or A(q) v = 0"};
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  const TracedProblem traced(problem);
  if (traced.constraint_count() == 0) return series;
  EquationsOfMotion motion(traced);
  Eigen::MatrixXd values(trajectory.stage_times.size(), traced.constraint_count());
  try {
    for (Eigen::Index row = 0; row < values.rows(); ++row) {
      values.row(row) = motion.multipliers(trajectory.stage(row), trajectory.stage_times[row]).transpose();
    }
  } catch (const Error&) {
    return series;
  }
  for (Eigen::Index a = 1; a <= values.cols(); ++a) series.names.push_back(fmt::format("{}", a));
  series.values = values;
  return series;
}

/// The constants of a motion and the prices of their bounds, in every row of a table: unknown parameters, integrals, T.
std::vector<Series> constants(const Problem& problem, const Trajectory& trajectory) {
  const auto repeated = [&](const Eigen::VectorXd& values) -> Eigen::MatrixXd {
    return values.transpose().replicate(trajectory.node_times.size(), 1);
  };
  const BoundMultipliers& prices = trajectory.prices;
  std::vector<std::string> integrals;
  for (Eigen::Index i = 1; i <= trajectory.integrals.size(); ++i) integrals.push_back(fmt::format("integral_{}", i));
  std::vector<Series> all{{"", unknown_names(problem), repeated(trajectory.unknowns), "unknown parameter"},
                          priced("price_", unknown_names(problem), repeated(prices.unknowns), "an unknown parameter"),
                          {"", integrals, repeated(trajectory.integrals), "integral over the trajectory"},
                          priced("price_", integrals, repeated(trajectory.integral_prices), "an integral")};
  if (trajectory.has_costates() && problem.bounds().horizon.is_free()) {
    all.push_back(priced("price_", {"horizon"}, repeated(Eigen::VectorXd::Constant(1, prices.horizon)), "T"));
  }
  return all;
}

/// The tables of all phases, one after the other, in the time of the whole motion, whose unit is `time_unit` times the
/// problem's: the first column, next to `phase`. Columns that a phase lacks are empty there.
template <class TableOf>
Table by_phase(const PhasedProblem& problem, const Trajectory& trajectory, const TableOf& table_of,
               double time_unit = 1.0) {
  std::vector<std::string> header;
  std::vector<Row> rows;
  std::map<std::string, ColumnFacts> facts{{"phase", {"", "phase of the trajectory", {FieldKind::text, false}}}};
  const std::vector<PhaseTrajectory> parts = phase_trajectories(problem, trajectory);
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto& [name, phase, follows] = problem.phases()[i];
    const SharedParameters shared(problem, *phase);
    const Table own = table_of(*phase, parts[i].motion);
    facts.insert(own.facts().begin(), own.facts().end());
    for (const std::string& column : own.columns()) {
      if (std::ranges::count(header, column) == 0 && column != "price_horizon") header.push_back(column);
      if (header.size() == 1) header.emplace_back("phase");
    }
    for (Row row : own.rows()) {
      row.set(header.front(), row.needed(header.front()) + time_unit * parts[i].start);
      row.set("phase", name);
      rows.push_back(std::move(row));
    }
  }
  Table table(header);
  table.describe(facts);
  for (Row& row : rows) table.append(std::move(row));
  return table;
}

/// A table with these fields in every row.
Table with_fields(const Table& table, const Table& fields) {
  std::vector<std::string> header = table.columns();
  std::ranges::copy_if(fields.columns(), std::back_inserter(header),
                       [&](const std::string& column) { return std::ranges::count(table.columns(), column) == 0; });
  Table all(header);
  all.describe(table.facts());
  all.describe(fields.facts());
  for (Row row : table.rows()) {
    for (const std::string& column : fields.columns()) {
      if (std::ranges::count(table.columns(), column) == 0) row.set(column, fields.rows().front().text(column));
    }
    all.append(std::move(row));
  }
  return all;
}

/// The quantities of all phases; one that several of them have has no bounds where they differ.
Table quantities_by_phase(const PhasedProblem& problem) {
  Table table;
  std::vector<Row> rows;
  for (const PhasedProblem::Phase& phase : problem.phases()) {
    const SharedParameters shared(problem, *phase.problem);
    table = quantity_table(*phase.problem);
    for (const Row& row : table.rows()) {
      if (!row.text("time").empty()) continue;  // a share of the phase's duration
      const auto known = std::ranges::find_if(rows, [&](const Row& other) {
        return other.text("kind") == row.text("kind") && other.text("quantity") == row.text("quantity");
      });
      if (known == rows.end()) {
        rows.push_back(row);
        continue;
      }
      for (const char* const side : {"lower", "upper"}) {
        if (known->text(side) != row.text(side)) known->set(side, Cell());
      }
    }
  }
  table.clear();
  for (Row& row : rows) table.append(std::move(row));
  return table;
}

/// The rows of a phase, their times less the first node's.
Table rows_of_phase(const Table& table, const std::string& phase, double start) {
  Table own(table.columns());
  for (Row row : table.rows()) {
    if (row.text("phase") != phase) continue;
    row.set("t", row.needed("t") - start);
    own.append(std::move(row));
  }
  return own;
}

void append_columns(Eigen::MatrixXd& to, const Eigen::MatrixXd& more, double factor) {
  if (more.cols() == 0) return;
  to.conservativeResize(more.rows(), to.cols() + more.cols());
  to.rightCols(more.cols()) = factor * more;
}

Trajectory motion_in_tables(const Problem& problem, const Table& nodes, const std::optional<Table>& stages,
                            const std::filesystem::path& file);

/// A motion whose phases follow each other, side by side. Unknowns without a column are the durations of the rows, or
/// guessed. Throws `Error` unless all phases have as many nodes.
Trajectory side_by_side(const PhasedProblem& problem, const Table& nodes, const std::optional<Table>& stages,
                        const std::filesystem::path& file) {
  Trajectory all;
  std::map<std::string, double> durations;
  for (std::size_t i = 0; i < problem.phases().size(); ++i) {
    const auto& [name, phase, follows] = problem.phases()[i];
    const auto first = std::ranges::find(nodes.rows(), name, [](const Row& row) { return row.text("phase"); });
    if (first == nodes.rows().end()) throw Error("{} has no rows of the phase {}", file.string(), name);
    const double start = first->needed("t");
    const SharedParameters shared(problem, *phase);
    const std::optional<Table> own_stages = stages ? std::optional(rows_of_phase(*stages, name, start)) : std::nullopt;
    const Trajectory own = motion_in_tables(*phase, rows_of_phase(nodes, name, start), own_stages, file);
    const double duration = durations[problem.name_of_duration(i)] = own.node_times.tail<1>()[0];
    const double share = duration / problem.horizon();
    if (all.node_times.size() == 0) {
      all.tableau = own.tableau;
      all.node_times = own.node_times / share;
      all.stage_times = own.stage_times / share;
    }
    if (own.q.rows() != all.node_times.size() || own.stage_u.rows() != all.stage_times.size()) {
      throw Error(
          "{}: the phase {} has {} nodes and {} controls, but the first phase has {} and {}; all phases need the same "
          "numbers of nodes and controls",
          file.string(), name, own.q.rows(), own.stage_u.rows(), all.node_times.size(), all.stage_times.size());
    }
    for (const TrajectoryTable& table : trajectory_tables) {
      append_columns(all.*table.values, own.*table.values, table.is_per_time ? share : 1.0);
    }
  }
  const std::vector<std::string> names = unknown_names(problem);
  all.unknowns.resize(std::ssize(names));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto duration = durations.find(names[i]);
    const double otherwise = duration == durations.end() ? problem.parameter(names[i]) : duration->second;
    const Row& row = nodes.rows().front();
    all.unknowns[static_cast<Eigen::Index>(i)] = row.text(names[i]).empty() ? otherwise : row.needed(names[i]);
  }
  return all;
}

bool has_phases(const Problem& problem, const Table& nodes) {
  return problem.phased() != nullptr && std::ranges::count(nodes.columns(), "phase") > 0;
}

/// One control per stage time, joined linearly: the trajectory of a one-stage method.
Trajectory motion_in_tables(const Problem& problem, const Table& nodes, const std::optional<Table>& stages,
                            const std::filesystem::path& file) {
  if (has_phases(problem, nodes)) return side_by_side(*problem.phased(), nodes, stages, file);
  Trajectory trajectory;
  trajectory.tableau = gauss_tableau(1);
  trajectory.node_times = times_in(nodes, file);
  if (trajectory.node_times.size() < 2) throw Error("{} contains no trajectory", file.string());
  if (std::abs(trajectory.node_times[0]) > 1e-9 * trajectory.node_times.tail<1>()[0])
    throw Error("{}: t must begin at 0", file.string());
  require_similar_horizon(problem, trajectory.node_times.tail<1>()[0], file);
  trajectory.q = columns(nodes, problem.configuration_names(), "", file);
  trajectory.v = columns(nodes, problem.configuration_names(), "v_", file);
  if (!stages) {
    trajectory.stage_times = trajectory.node_times;
    trajectory.stage_u = controls_at_nodes(problem, nodes, trajectory.node_times, file);
  } else {
    const std::filesystem::path stages_file = stages_file_of(file);
    trajectory.stage_times = times_in(*stages, stages_file);
    if (trajectory.stage_times.size() == 0) throw Error("{} contains no trajectory", stages_file.string());
    require_one_motion(trajectory, file, stages_file);
    trajectory.stage_u = columns(*stages, problem.control_names(), "", stages_file);
  }
  trajectory.y = columns(nodes, problem.first_order_names(), "", file);
  read_costates(problem, nodes, file, trajectory);
  read_unknowns(problem, nodes, file, trajectory);
  return trajectory;
}

}  // namespace

Table node_table(const Problem& problem, const Trajectory& trajectory) {
  if (const PhasedProblem* const phased = problem.phased()) {
    return with_fields(by_phase(*phased, trajectory, node_table),
                       series_table("t", trajectory.node_times, constants(problem, trajectory)));
  }
  const std::vector<std::string> names = problem.configuration_names();
  std::vector<Series> all{{"", names, trajectory.q, "configuration q"},
                          {"v_", names, trajectory.v, "velocity v"},
                          {"p_", names, trajectory.p, "momentum p = L_v"},
                          {"psi_q_", names, trajectory.psi_q, "costate of q"},
                          {"psi_p_", names, trajectory.psi_p, "costate of p"},
                          {"", problem.first_order_names(), trajectory.y, "first-order state"},
                          {"psi_", problem.first_order_names(), trajectory.psi_y, "costate of a first-order state"},
                          priced("price_", names, trajectory.prices.q, "q"),
                          priced("price_v_", names, trajectory.prices.v, "velocity v"),
                          priced("price_", problem.first_order_names(), trajectory.prices.y, "a first-order state")};
  std::ranges::move(constants(problem, trajectory), std::back_inserter(all));
  return series_table("t", trajectory.node_times, all);
}

Table stage_table(const Problem& problem, const Trajectory& trajectory) {
  if (const PhasedProblem* const phased = problem.phased()) return by_phase(*phased, trajectory, stage_table);
  const BoundMultipliers& prices = trajectory.prices;
  const std::string rate = " per unit of time";
  return series_table(
      "t", trajectory.stage_times,
      {{"", problem.control_names(), trajectory.stage_u, "control u"},
       multipliers_at_stages(problem, trajectory),
       priced("price_", problem.control_names(), prices.stage_u, "u," + rate),
       priced("price_v_", problem.configuration_names(), prices.stage_v, "a velocity," + rate),
       priced("price_", constraint_names(problem, prices.path.cols()), prices.path, "a path constraint," + rate)});
}

Table picture_table(const Problem& problem, const Trajectory& trajectory) {
  if (const PhasedProblem* const phased = problem.phased()) {
    return by_phase(*phased, trajectory, picture_table, problem.card().time_unit.factor);
  }
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  std::vector<std::string> names;
  std::vector<std::string> units;
  const auto formulas = [&](const ControlledState& x) {
    const Picture picture = pictured_quantities(problem, x);
    ExpressionVector values(static_cast<Eigen::Index>(picture.size()));
    for (std::size_t i = 0; i < picture.size(); ++i) {
      names.push_back(name_with_unit(picture[i].name, picture[i].unit));
      units.push_back(picture[i].unit);
      values[static_cast<Eigen::Index>(i)] = picture[i].value;
    }
    return values;
  };
  PointFunction quantities(problem, formulas);
  Eigen::MatrixXd values(trajectory.node_times.size(), quantities.output_count());
  Eigen::VectorXd at_node(quantities.output_count());
  for (Eigen::Index k = 0; k < trajectory.node_times.size(); ++k) {
    const double t = trajectory.node_times[k];
    MotionPoint node = trajectory.node(k);
    node.u = control_at(trajectory, t);
    quantities.evaluate(node, t, at_node);
    values.row(k) = at_node.transpose();
  }
  const Unit time = problem.card().time_unit;
  return series_table(name_with_unit("t", time.name), trajectory.node_times * time.factor,
                      {{"", names, values, "a quantity of the picture", units}}, time.name);
}

Table constraint_table(const Problem& problem, const Trajectory& trajectory) {
  if (const PhasedProblem* const phased = problem.phased()) return by_phase(*phased, trajectory, constraint_table);
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  PointFunction constraints = path_function(problem);
  const Eigen::Index count = constraints.output_count();
  if (count == 0) return {};
  Eigen::MatrixXd values(trajectory.node_times.size(), count);
  Eigen::VectorXd at_node(count);
  for (Eigen::Index k = 0; k < trajectory.node_times.size(); ++k) {
    const double t = trajectory.node_times[k];
    MotionPoint node = trajectory.node(k);
    node.u = control_at(trajectory, t);
    constraints.evaluate(node, t, at_node);
    values.row(k) = at_node.transpose();
  }
  return series_table("t", trajectory.node_times,
                      {{"", constraint_names(problem, count), values, "a path constraint"}});
}

Table quantity_table(const Problem& problem) {
  if (const PhasedProblem* const phased = problem.phased()) return quantities_by_phase(*phased);
  const ProblemCard card = problem.card();
  const ProblemBounds bounds = problem.bounds();
  Table table({"kind", "quantity", "unit", "lower", "upper", "time"});
  constexpr FieldType text{FieldKind::text, true};
  constexpr FieldType number{FieldKind::number, true};
  table.describe(
      {{"kind", {"", "t, q, u, or h (path constraint)", text}},
       {"quantity", {"", "name of the column in the tables of the trajectory", text}},
       {"unit", {"", "unit that the problem states; empty if it states none", text}},
       {"lower", {"", "lower bound; empty if there is none", number}},
       {"upper", {"", "upper bound; empty if there is none", number}},
       {"time",
        {"", "time at which the bounds hold, as a share of T; empty for bounds along the whole trajectory", number}}});
  table.set_key({"kind", "quantity", "time"});
  Row time;
  time.set("kind", "t");
  time.set("quantity", "t");
  if (card.time_unit.factor == 1.0) time.set("unit", card.time_unit.name);
  table.append(std::move(time));
  const auto add = [&](const char* kind, const std::vector<std::string>& names, const std::vector<std::string>& units,
                       const Bounds& of, std::optional<double> at = std::nullopt) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto entry = static_cast<Eigen::Index>(i);
      if (at && of.lower.size() == 0) continue;
      Row row;
      row.set("kind", kind);
      row.set("quantity", names[i]);
      row.set("unit", i < units.size() ? units[i] : "");
      if (entry < of.lower.size() && std::isfinite(of.lower[entry])) row.set("lower", of.lower[entry]);
      if (entry < of.upper.size() && std::isfinite(of.upper[entry])) row.set("upper", of.upper[entry]);
      row.set("time", at);
      table.append(std::move(row));
    }
  };
  add("q", problem.configuration_names(), card.configuration_units, bounds.q);
  for (const InteriorBounds& at : bounds.interior)
    add("q", problem.configuration_names(), card.configuration_units, at.q, at.relative_time);
  add("u", problem.control_names(), card.control_units, bounds.u);
  const Eigen::Index count = path_function(problem).output_count();
  add("h", constraint_names(problem, count), {}, bounds.of_path(count));
  return table;
}

void write_motion(const Problem& problem, const Trajectory& trajectory, const std::filesystem::path& nodes_file) {
  const std::filesystem::path stages_file = stages_file_of(nodes_file);
  const std::string nodes = node_table(problem, trajectory).csv();
  const std::string stages = stage_table(problem, trajectory).csv();
  for (const auto& [file, text] : {std::pair(&stages_file, &stages), std::pair(&nodes_file, &nodes)}) {
    std::ofstream stream(*file, std::ios::binary);
    stream << *text << std::flush;
    if (!stream) throw Error("cannot write {}", file->string());
  }
}

std::filesystem::path stages_file_of(const std::filesystem::path& nodes_file) {
  constexpr std::string_view ending = "_nodes.csv";
  const std::string name = nodes_file.string();
  if (name.size() <= ending.size() || !name.ends_with(ending)) {
    throw Error("the name of a node table must end with {}, but is {}", ending, name);
  }
  return name.substr(0, name.size() - ending.size()) + "_stages.csv";
}

bool is_file_of_motion(const std::filesystem::path& file, const std::string& nodes_file) {
  const std::string name = nodes_file.substr(0, nodes_file.rfind("_nodes.csv"));
  std::error_code none;  // they need not exist
  return std::filesystem::equivalent(file, nodes_file, none) ||
         std::filesystem::equivalent(file, name + "_stages.csv", none);
}

MotionTexts read_motion_texts(const std::filesystem::path& file) {
  std::error_code none;  // a missing file has no stages next to it
  if (!std::filesystem::exists(file, none)) throw Error("there is no file {}", file.string());
  MotionTexts texts{.nodes = read_file(file)};
  if (!file.string().ends_with("_nodes.csv")) return texts;
  const std::filesystem::path stages_file = stages_file_of(file);
  if (std::filesystem::exists(stages_file, none)) texts.stages = read_file(stages_file);
  return texts;
}

Trajectory read_motion_tables(const Problem& problem, const std::filesystem::path& nodes_file) {
  return motion_in_texts(problem, read_motion_texts(nodes_file), nodes_file);
}

Trajectory motion_in_texts(const Problem& problem, const MotionTexts& texts, const std::filesystem::path& file) {
  std::optional<Table> stages;
  const Table nodes = table_in(texts.nodes, file);
  if (!texts.stages.empty()) stages = table_in(texts.stages, stages_file_of(file));
  return motion_in_tables(problem, nodes, stages, file);
}

}  // namespace dmocbench
