#include "bench/run/indirect_reference.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "bench/run/result_file.hpp"
#include "bench/run/solve_case.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/error.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/runtime/clock.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

Json parameters_of(const Problem& problem) {
  Json parameters = Json::object();
  for (const Parameter& parameter : problem.parameters()) parameters[parameter.name] = parameter.value;
  return parameters;
}

Json columns_of(const Eigen::MatrixXd& matrix) {
  Json columns = Json::array();
  for (const auto& column : matrix.colwise()) columns.push_back(std::vector<double>(column.begin(), column.end()));
  return columns;
}

Eigen::MatrixXd matrix_of(const JsonPlace& place) {
  const std::vector<JsonPlace> columns = place.entries();
  if (columns.empty()) return {};
  Eigen::MatrixXd matrix(std::ssize(columns.front().numbers()), std::ssize(columns));
  for (Eigen::Index j = 0; const JsonPlace& each : columns) {
    const std::vector<double> column = each.numbers();
    if (std::ssize(column) != matrix.rows()) throw Error("columns differ in length");
    matrix.col(j++) = Eigen::Map<const Eigen::VectorXd>(column.data(), matrix.rows());
  }
  return matrix;
}

/// Checksum of a file without the entry `checksum`. It finds damaged digits, also those that no equation uses.
std::uint32_t checksum_without_itself(Json file) {
  file.erase("checksum");
  return crc_32(file.dump());
}

std::string written(const Problem& problem, const IndirectSolution& solution) {
  const CollocatedExtremal& extremal = solution.extremal();
  const IndirectAgreement& agreement = solution.agreement();
  Json file{{"problem", problem.name()},
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
  file["checksum"] = checksum_without_itself(file);
  return file.dump() + "\n";
}

bool is_near(const IndirectSolution& solution, const Trajectory& direct) {
  const auto at = [&solution](double t) {
    IndirectPoint point = solution.at(t);
    return MotionPoint{.q = std::move(point.q), .v = std::move(point.v), .u = std::move(point.u)};
  };
  return is_on_branch(direct, {at, solution.extremal().horizon});
}

void require_near(const Problem& problem, const IndirectSolution& solution, const Trajectory& direct) {
  if (is_near(solution, direct)) return;
  throw Error("the indirect solution of " + problem.name() +
              " is on a different branch from the row, so the row has no errors; run only this method on finer grids");
}

/// The solution in a file; empty if there is no such file or it is not a solution of this problem on this branch.
std::optional<IndirectSolution> read_solution(const std::filesystem::path& path, const Problem& problem,
                                              const Trajectory& direct) {
  constexpr double rounding = 1e-11;
  std::error_code none;  // a pipe or a folder holds no solution either
  if (!std::filesystem::is_regular_file(path, none)) return std::nullopt;
  try {
    const Json json = json_in(read_file(path), path.string());
    const JsonPlace file(json, path.string());
    if (file.at("problem").text() != problem.name()) return std::nullopt;
    if (file.at("parameters").json() != parameters_of(problem)) return std::nullopt;
    if (file.at("checksum").json() != checksum_without_itself(json)) return std::nullopt;
    CollocatedExtremal extremal;
    extremal.stages = file.at("stages").count();
    extremal.horizon = file.at("horizon").number();
    extremal.cost = file.at("scaled_cost").number();
    extremal.nodes = matrix_of(file.at("nodes"));
    extremal.rates = matrix_of(file.at("slopes"));
    extremal.algebraic = matrix_of(file.at("algebraic"));
    const JsonPlace agreement = file.at("agreement");
    IndirectSolution solution(problem, std::move(extremal),
                              {.state = agreement.at("state").number(),
                               .costate = agreement.at("costate").number(),
                               .control = agreement.at("control").number(),
                               .cost = agreement.at("cost").number()});
    if (boundary_value_residual(problem, solution) > rounding || !is_near(solution, direct)) return std::nullopt;
    return solution;
  } catch (const std::exception&) {
    return std::nullopt;  // a file of another origin is rewritten
  }
}

using Entry = CheckedIndirectSolution;
constexpr auto solution_of = &Entry::solution;
constexpr auto agreement_of = &IndirectSolution::agreement;
constexpr auto extremal_of = &IndirectSolution::extremal;
const Columns<Entry> reference_columns{
    {"problem", "", "name of the problem", from(&Entry::problem), in_key},
    {"cost", "cost", "optimal cost", from(solution_of, &IndirectSolution::cost)},
    {"certified_digits", "", "number of digits on which two solves with different orders and grids agree",
     from(solution_of, &IndirectSolution::certified_digits)},
    {"state_agreement", "", "relative difference of the states of both solves",
     from(solution_of, agreement_of, &IndirectAgreement::state)},
    {"costate_agreement", "", "relative difference of the costates of both solves",
     from(solution_of, agreement_of, &IndirectAgreement::costate)},
    {"control_agreement", "", "relative difference of the controls of both solves",
     from(solution_of, agreement_of, &IndirectAgreement::control)},
    {"cost_agreement", "", "relative difference of the costs of both solves",
     from(solution_of, agreement_of, &IndirectAgreement::cost)},
    {"hamiltonian_drift", "", "relative range (max - min) of the Hamiltonian; empty if the problem depends on time",
     from(solution_of, &IndirectSolution::hamiltonian_drift)},
    {"shooting_defect", "", "largest relative distance between a node and the integration from the preceding node",
     from(&Entry::shooting_defect)},
    {"replay_error", "", "distance between the end of the replay and the final state", from(&Entry::replay_error)},
    {"stages", "", "number of Gauss points per interval", from(solution_of, extremal_of, &CollocatedExtremal::stages)},
    {"intervals", "", "number of intervals", from(solution_of, extremal_of, &CollocatedExtremal::intervals)},
    {"seconds", "s", "time of the solve; empty if the solution was read from a file", from(&Entry::seconds)},
};

/// The entry of a solution in table and metadata.
Json account_of(const Entry& entry) {
  Row row = row_of(reference_columns, entry);
  Json metadata{{"problem", entry.problem},
                {"cost", entry.solution.cost()},
                {"certified_digits", entry.solution.certified_digits()},
                {"shooting_defect", entry.shooting_defect},
                {"replay_error", entry.replay_error}};
  Json cells = Json::object();
  for (const std::string& name : names_of(reference_columns)) cells[name] = row.text(name);
  for (const auto& [name, value] : entry.initial_costate) {
    cells[name] = Cell(value).text();
    metadata["initial_costate"][name] = value;
  }
  return {{"cells", std::move(cells)}, {"metadata", std::move(metadata)}};
}

/// The solution near a direct one, from the problem's file in a folder, or else solved and written there.
/// Where that fails, `notes` gets the reason: the solution is as good without a file.
Entry solution_near(const Problem& problem, const Trajectory& direct, const std::filesystem::path& folder,
                    std::vector<std::string>& notes) {
  const std::filesystem::path path = folder / (problem.name() + "_indirect.json");
  std::optional<IndirectSolution> solution = read_solution(path, problem, direct);
  std::optional<double> seconds;
  if (!solution) {
    const auto begin = Clock::now();
    solution = solve_indirect(problem, direct);
    seconds = seconds_since(begin);
    require_near(problem, *solution, direct);
    try {
      write_file(path, written(problem, *solution));
    } catch (const Error& error) {
      notes.push_back(fmt::format("{}: the indirect solution is not saved: {}", problem.name(), error.what()));
    }
  }
  constexpr double replay_tolerance = 1e-13;
  Entry entry{.problem = problem.name(), .solution = *std::move(solution), .seconds = seconds, .initial_costate = {}};
  entry.replay_error = replay_error(problem, entry.solution.trajectory(), replay_tolerance).norm();
  entry.shooting_defect = shooting_defect(problem, entry.solution);
  const IndirectPoint start = entry.solution.at(0.0);
  for (const auto& [prefix, costate] : {std::pair("psi_q_", start.psi_q), std::pair("psi_p_", start.psi_p)}) {
    for (Eigen::Index i = 0; const std::string& name : problem.configuration_names()) {
      entry.initial_costate.emplace_back(prefix + name, costate[i++]);
    }
  }
  return entry;
}

}  // namespace

const IndirectSolution& IndirectReference::near(const Problem& problem, const Trajectory& direct) {
  const auto known = known_.find(problem.name());
  if (known == known_.end())
    return known_.emplace(problem.name(), solution_near(problem, direct, folder_, notes_)).first->second.solution;
  require_near(problem, known->second.solution, direct);
  return known->second.solution;
}

Json IndirectReference::findings() const {
  std::map<std::string, Json> accounts = joined_;
  for (const auto& [problem, entry] : known_) accounts[problem] = account_of(entry);
  return accounts;
}

void IndirectReference::add_findings(const JsonPlace& findings) {
  if (findings.json().is_null()) return;
  for (const auto& [problem, account] : findings.members()) {
    for (const auto& [column, cell] : account.at("cells").members()) static_cast<void>(cell.text());
    static_cast<void>(account.at("metadata").at("certified_digits").number());
    joined_[problem] = account.json();
  }
}

Table IndirectReference::table() const {
  const Json accounts = findings();
  std::vector<std::string> names = names_of(reference_columns);
  for (const Json& account : accounts) {
    for (const auto& [name, value] : account.at("cells").items()) {
      if (std::ranges::count(names, name) == 0) names.push_back(name);
    }
  }
  Table table(names);
  table.describe(facts_of(reference_columns));
  table.set_key(key_of(reference_columns));
  for (const std::string& name : names) {  // names that the columns above do not explain
    table.describe({{name, {"", "costate at t = 0", {FieldKind::number, true}}}});
  }
  for (const Json& account : accounts) {
    Row row;
    for (const auto& [name, value] : account.at("cells").items()) row.set(name, value.get<std::string>());
    table.append(std::move(row));
  }
  return table;
}

Json IndirectReference::metadata() const {
  const Json accounts = findings();
  Json references = Json::array();
  for (const Json& account : accounts) references.push_back(account.at("metadata"));
  return references;
}

std::vector<std::string> IndirectReference::notes() const {
  constexpr double wanted_digits = 11.0;
  const Json accounts = findings();
  std::vector<std::string> notes = notes_;
  for (const auto& [problem, account] : accounts.items()) {
    const double digits = account.at("metadata").at("certified_digits");
    if (digits >= wanted_digits) continue;
    notes.push_back(fmt::format(
        "{}: the indirect reference is certified to only {:.1f} digits; smaller relative errors are not meaningful",
        problem, digits));
  }
  return notes;
}

}  // namespace dmocbench
