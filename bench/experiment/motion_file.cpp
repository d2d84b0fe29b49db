#include "bench/experiment/motion_file.hpp"

#include <fmt/format.h>

#include "bench/experiment/result_file.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/point_function.hpp"

namespace dmocbench {

namespace {

std::vector<double> column(const Table& table, const std::string& name, const std::filesystem::path& file) {
  std::vector<double> values;
  for (const Row& row : table.rows()) {
    const auto value = row.number(name);
    if (!value) {
      throw Error(fmt::format("{}: column {} is missing or has a field that is not a number", file.string(), name));
    }
    values.push_back(*value);
  }
  return values;
}

Eigen::MatrixXd columns(const Table& table, const std::vector<std::string>& names, const std::string& prefix,
                        const std::filesystem::path& file) {
  Eigen::MatrixXd values(static_cast<Eigen::Index>(table.rows().size()), static_cast<Eigen::Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::vector<double> entries = column(table, prefix + names[i], file);
    values.col(static_cast<Eigen::Index>(i)) = Eigen::Map<const Eigen::VectorXd>(entries.data(), values.rows());
  }
  return values;
}

}  // namespace

Table node_table(const Problem& problem, const Trajectory& trajectory) {
  const std::vector<std::string> names = problem.configuration_names();
  std::vector<std::string> header{"t"};
  for (const char* prefix : {"", "v_", "p_", "psi_q_", "psi_p_"}) {
    for (const std::string& name : names) header.push_back(prefix + name);
  }
  Table table(header);
  for (Eigen::Index k = 0; k < trajectory.node_times.size(); ++k) {
    Row row;
    row.set("t", trajectory.node_times[k]);
    for (std::size_t name = 0; name < names.size(); ++name) {
      const auto i = static_cast<Eigen::Index>(name);
      row.set(names[name], trajectory.q(k, i));
      row.set("v_" + names[name], trajectory.v(k, i));
      row.set("p_" + names[name], trajectory.p(k, i));
      if (!trajectory.has_costates()) continue;
      row.set("psi_q_" + names[name], trajectory.psi_q(k, i));
      row.set("psi_p_" + names[name], trajectory.psi_p(k, i));
    }
    table.append(std::move(row));
  }
  return table;
}

Table stage_table(const Problem& problem, const Trajectory& trajectory) {
  const std::vector<std::string> names = problem.control_names();
  std::vector<std::string> header{"t"};
  header.insert(header.end(), names.begin(), names.end());
  Table table(header);
  for (Eigen::Index i = 0; i < trajectory.stage_times.size(); ++i) {
    Row row;
    row.set("t", trajectory.stage_times[i]);
    for (std::size_t c = 0; c < names.size(); ++c) {
      row.set(names[c], trajectory.stage_u(i, static_cast<Eigen::Index>(c)));
    }
    table.append(std::move(row));
  }
  return table;
}

Table picture_table(const Problem& problem, const Trajectory& trajectory) {
  const Unit time = problem.card().time_unit;
  std::vector<std::string> header{fmt::format("t_[{}]", time.name)};
  PointFunction quantities(problem.configuration_size(), problem.control_size(), [&](const ControlledState& x) {
    const std::vector<PictureQuantity> picture = problem.picture(x);
    ExpressionVector values(static_cast<Eigen::Index>(picture.size()));
    for (std::size_t i = 0; i < picture.size(); ++i) {
      header.push_back(picture[i].unit.empty() ? picture[i].name
                                               : fmt::format("{}_[{}]", picture[i].name, picture[i].unit));
      values[static_cast<Eigen::Index>(i)] = picture[i].value;
    }
    return values;
  });
  Table table(header);
  Eigen::VectorXd values(quantities.output_count());
  for (Eigen::Index k = 0; k < trajectory.node_times.size(); ++k) {
    const double t = trajectory.node_times[k];
    quantities.evaluate(trajectory.q.row(k).transpose(), trajectory.v.row(k).transpose(), control_at(trajectory, t), t,
                        values);
    Row row;
    row.set(header[0], t * time.factor);
    for (Eigen::Index i = 0; i < values.size(); ++i) row.set(header[static_cast<std::size_t>(i) + 1], values[i]);
    table.append(std::move(row));
  }
  return table;
}

Motion read_motion(const Problem& problem, const std::filesystem::path& nodes_file) {
  const std::string ending = "_nodes.csv";
  const std::string name = nodes_file.string();
  if (name.size() <= ending.size() || name.compare(name.size() - ending.size(), ending.size(), ending) != 0) {
    throw Error(fmt::format("--start {} is none of: common, guess, a file X_nodes.csv written by solve", name));
  }
  const std::filesystem::path stages_file = name.substr(0, name.size() - ending.size()) + "_stages.csv";
  const Table nodes = Table::from_csv(read_file(nodes_file));
  const Table stages = Table::from_csv(read_file(stages_file));

  // One control per stage time, joined linearly: the trajectory of a one-stage method, whatever wrote the file.
  Trajectory trajectory;
  const std::vector<double> times = column(nodes, "t", nodes_file);
  const std::vector<double> stage_times = column(stages, "t", stages_file);
  if (times.size() < 2 || stage_times.empty()) throw Error(fmt::format("{} holds no motion", nodes_file.string()));
  trajectory.tableau = gauss_tableau(1);
  trajectory.node_times = Eigen::Map<const Eigen::VectorXd>(times.data(), static_cast<Eigen::Index>(times.size()));
  trajectory.stage_times =
      Eigen::Map<const Eigen::VectorXd>(stage_times.data(), static_cast<Eigen::Index>(stage_times.size()));
  trajectory.q = columns(nodes, problem.configuration_names(), "", nodes_file);
  trajectory.v = columns(nodes, problem.configuration_names(), "v_", nodes_file);
  trajectory.stage_u = columns(stages, problem.control_names(), "", stages_file);
  return smooth_motion(trajectory);
}

}  // namespace dmocbench
