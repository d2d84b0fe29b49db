#include "bench/experiment/indirect_reference.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bench/experiment/result_file.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/error.hpp"
#include "methods/indirect/solve_indirect.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> common_columns{"problem",
                                              "cost",
                                              "certified_digits",
                                              "state_agreement",
                                              "costate_agreement",
                                              "control_agreement",
                                              "cost_agreement",
                                              "hamiltonian_drift",
                                              "shooting_defect",
                                              "replay_error",
                                              "stages",
                                              "intervals",
                                              "seconds"};

Json parameters_of(const Problem& problem) {
  Json parameters = Json::object();
  for (const Parameter& parameter : problem.parameters()) parameters[parameter.name] = parameter.value;
  return parameters;
}

Json columns_of(const Eigen::MatrixXd& matrix) {
  Json columns = Json::array();
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    columns.push_back(std::vector<double>(matrix.col(j).begin(), matrix.col(j).end()));
  }
  return columns;
}

Eigen::MatrixXd matrix_of(const Json& columns) {
  const auto values = columns.get<std::vector<std::vector<double>>>();
  if (values.empty()) return {};
  Eigen::MatrixXd matrix(values.front().size(), values.size());
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (values[j].size() != values.front().size()) throw Error("columns differ in length");
    matrix.col(static_cast<Eigen::Index>(j)) = Eigen::Map<const Eigen::VectorXd>(values[j].data(), matrix.rows());
  }
  return matrix;
}

std::string written(const Problem& problem, const IndirectSolution& solution) {
  const CollocatedExtremal& extremal = solution.extremal();
  const IndirectAgreement& agreement = solution.agreement();
  const Json file{{"problem", problem.name()},
                  {"parameters", parameters_of(problem)},
                  {"stages", extremal.stages},
                  {"horizon", extremal.horizon},
                  {"scaled_cost", extremal.cost},
                  {"agreement",
                   {{"state", agreement.state},
                    {"costate", agreement.costate},
                    {"control", agreement.control},
                    {"cost", agreement.cost}}},
                  {"nodes", columns_of(extremal.nodes)},
                  {"slopes", columns_of(extremal.rates)},
                  {"algebraic", columns_of(extremal.algebraic)}};
  return file.dump() + "\n";
}

/// The same branch as in the column `branch`: no node further away than a tenth of the range.
bool is_near(const IndirectSolution& solution, const Trajectory& direct) {
  constexpr double tenth = 0.1;
  const Eigen::VectorXd range = direct.q.colwise().maxCoeff() - direct.q.colwise().minCoeff();
  for (Eigen::Index k = 0; k < direct.node_times.size(); ++k) {
    const Eigen::VectorXd distance = solution.at(direct.node_times[k]).q - direct.q.row(k).transpose();
    if (distance.lpNorm<Eigen::Infinity>() > tenth * range.maxCoeff()) return false;
  }
  return true;
}

double number_in(const Row& row, const std::string& column) { return row.number(column).value_or(0.0); }

void require_near(const Problem& problem, const IndirectSolution& solution, const Trajectory& direct) {
  if (is_near(solution, direct)) return;
  throw Error("the indirect solution of " + problem.name() +
              " is on another branch than this row, which has no errors therefore; run its method alone, on finer "
              "grids");
}

/// The solution in a file; none if there is no such file or it is not one of this problem on this branch.
std::optional<IndirectSolution> read_solution(const std::filesystem::path& path, const Problem& problem,
                                              const Trajectory& direct) {
  constexpr double rounding = 1e-11;
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    const Json file = Json::parse(read_file(path));
    if (file.at("problem") != problem.name() || file.at("parameters") != parameters_of(problem)) return std::nullopt;
    CollocatedExtremal extremal;
    extremal.stages = file.at("stages").get<int>();
    extremal.horizon = file.at("horizon").get<double>();
    extremal.cost = file.at("scaled_cost").get<double>();
    extremal.nodes = matrix_of(file.at("nodes"));
    extremal.rates = matrix_of(file.at("slopes"));
    extremal.algebraic = matrix_of(file.at("algebraic"));
    const Json& agreement = file.at("agreement");
    IndirectSolution solution(problem, std::move(extremal),
                              {.state = agreement.at("state").get<double>(),
                               .costate = agreement.at("costate").get<double>(),
                               .control = agreement.at("control").get<double>(),
                               .cost = agreement.at("cost").get<double>()});
    if (boundary_value_residual(problem, solution) > rounding || !is_near(solution, direct)) return std::nullopt;
    return solution;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // a file that is not ours is written anew
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

const IndirectSolution& IndirectReference::near(const Problem& problem, const Trajectory& direct) {
  const auto known = entries_.find(problem.name());
  if (known != entries_.end()) {
    require_near(problem, known->second.solution, direct);
    return known->second.solution;
  }

  const std::filesystem::path path = folder_ / (problem.name() + "_indirect.json");
  std::optional<IndirectSolution> solution = read_solution(path, problem, direct);
  std::optional<double> seconds;
  if (!solution) {
    const auto begin = std::chrono::steady_clock::now();
    solution = solve_indirect(problem, direct);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    require_near(problem, *solution, direct);
    write_file(path, written(problem, *solution));
  }

  Row row;
  row.set("problem", problem.name());
  row.set("cost", solution->cost());
  row.set("certified_digits", solution->certified_digits());
  row.set("state_agreement", solution->agreement().state);
  row.set("costate_agreement", solution->agreement().costate);
  row.set("control_agreement", solution->agreement().control);
  row.set("cost_agreement", solution->agreement().cost);
  row.set("hamiltonian_drift", solution->hamiltonian_drift());
  constexpr double replay_tolerance = 1e-13;
  row.set("replay_error", replay_error(problem, solution->trajectory(), replay_tolerance).norm());
  row.set("shooting_defect", shooting_defect(problem, *solution));
  row.set("stages", static_cast<long long>(solution->extremal().stages));
  row.set("intervals", static_cast<long long>(solution->extremal().intervals()));
  row.set("seconds", seconds);
  std::vector<std::string> costate_columns;
  const IndirectPoint start = solution->at(0.0);
  const auto add_costate = [&](const std::string& prefix, const Eigen::VectorXd& values) {
    Eigen::Index i = 0;
    for (const std::string& name : problem.configuration_names()) {
      costate_columns.push_back(prefix + name);
      row.set(costate_columns.back(), values[i++]);
    }
  };
  add_costate("psi_q_", start.psi_q);
  add_costate("psi_p_", start.psi_p);
  return entries_.emplace(problem.name(), Entry{*std::move(solution), std::move(row), std::move(costate_columns)})
      .first->second.solution;
}

Table IndirectReference::table() const {
  std::vector<std::string> columns = common_columns;
  for (const auto& [name, entry] : entries_) {
    for (const std::string& column : entry.costate_columns) {
      if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
    }
  }
  Table table(columns);
  for (const auto& [name, entry] : entries_) table.append(entry.row);
  return table;
}

nlohmann::ordered_json IndirectReference::metadata() const {
  Json references = Json::array();
  for (const auto& [name, entry] : entries_) {
    Json reference = Json::object();
    reference["problem"] = name;
    for (const std::string column : {"cost", "certified_digits", "shooting_defect", "replay_error"}) {
      reference[column] = number_in(entry.row, column);
    }
    for (const std::string& column : entry.costate_columns)
      reference["initial_costate"][column] = number_in(entry.row, column);
    references.push_back(std::move(reference));
  }
  return references;
}

std::vector<std::string> IndirectReference::notes() const {
  constexpr double wanted_digits = 11.0;
  std::vector<std::string> notes;
  for (const auto& [name, entry] : entries_) {
    const double digits = entry.solution.certified_digits();
    if (digits >= wanted_digits) continue;
    notes.push_back(
        fmt::format("{}: the indirect reference is certified to {:.1f} digits only; smaller relative "
                    "errors say nothing",
                    name, digits));
  }
  return notes;
}

}  // namespace dmocbench
