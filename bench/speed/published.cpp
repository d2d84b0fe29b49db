// Times that others have published beside ours: the same problems and numbers of intervals, on this machine.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/run/column.hpp"
#include "bench/run/result_file.hpp"
#include "bench/speed/guessed_program.hpp"
#include "bench/speed/measured_page.hpp"
#include "methods/diagnostics/convergence_order.hpp"
#include "methods/error.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// A solve of ours that stands beside published ones.
struct OwnSolve {
  std::string problem;
  std::string method;
  int intervals = 0;
  int stages = 1;
  bool is_straight = false;  ///< starts at the straight line between the ends and not at the problem's guess
};

const std::vector<OwnSolve>& own_solves() {
  static const std::vector<OwnSolve> solves{
      {"double_oscillator", "dmoc", 10000}, {"double_oscillator", "hamiltonian", 10000},
      {"hang_glider", "dmoc", 10000},       {"hang_glider", "tangent", 10000},
      {"rigid_quadrotor", "dmoc", 200000},  {"cart_pole", "dmoc", 64, 3},
      {"cart_pole", "dmoc", 64, 3, true},   {"beam", "dmoc", 10000},
      {"beam", "hamiltonian", 10000},       {"beam", "dmoc", 20000},
      {"beam", "hamiltonian", 20000},
  };
  return solves;
}

/// A program of ours, made once and solved in every round.
class TimedRival {
 public:
  explicit TimedRival(OwnSolve solve)
      : solve_(std::move(solve)), made_(make_problem(solve_.problem), solve_.method, solve_.intervals, solve_.stages) {
    const Problem& problem = *made_.problem;
    const Motion straight{.at = [&](double t) { return problem.Problem::guess(t); }, .horizon = problem.horizon()};
    if (solve_.is_straight) made_.start = sample(*made_.program, straight);
  }

  /// A short solve is timed the second time: the first finds caches and memory as longer solves have left them.
  void solve() {
    constexpr double short_solve = 0.1;  // s
    const auto solver = make_solver("interior_point");
    solution_ = solver->solve(*made_.program, made_.start);
    if (solution_.seconds < short_solve) solution_ = solver->solve(*made_.program, made_.start);
    seconds_.push_back(solution_.seconds);
  }

  [[nodiscard]] Row row() const {
    Row row;
    row.set("problem", solve_.problem);
    row.set("intervals", solve_.intervals);
    row.set("who",
            fmt::format("{}, s = {}{}", solve_.method, solve_.stages, solve_.is_straight ? ", straight line" : ""));
    row.set("where", "here");
    row.set("machine", fmt::format("here, {} threads", thread_count()));
    row.set("rounds", seconds_.size());
    row.set("setup_seconds", made_.setup_seconds);
    row.set("iterations", solution_.major_iterations);
    row.set("status", std::string(name_of(solution_.status)));
    if (!is_solved(solution_.status)) return row;
    const MedianOfRounds seconds(seconds_);
    row.set("seconds", seconds.median);
    row.set("seconds_lower", seconds.lower);
    row.set("seconds_upper", seconds.upper);
    row.set("smallest_seconds", std::ranges::min(seconds_));
    row.set("objective", solution_.objective / made_.problem->cost_scale());
    return row;
  }

 private:
  OwnSolve solve_;
  GuessedProgram made_;
  Solution solution_;
  std::vector<double> seconds_;
};

/// How far a cost is off the problem's reference, as a share of it; empty without either.
void set_cost_error(Row& row) {
  const auto reference = make_problem(row.text("problem"))->card().reference;
  const auto objective = row.number("objective");
  if (reference && objective) row.set("cost_error", std::abs(*objective / reference->objective - 1.0));
}

/// The order of the error in the cost of the beam, of which the closed form is known, where nodes lie where its bound
/// begins and ends to be active.
std::string order_of_beam(const std::string& method) {
  std::vector<GridError> errors;
  const auto problem = std::shared_ptr<const Problem>(make_problem("beam"));
  for (const int intervals : {160, 320, 640, 1280, 2560}) {
    const GuessedProgram made(problem, method, intervals);
    const Solution solution = make_solver("interior_point")->solve(*made.program, made.start);
    if (!is_solved(solution.status)) continue;
    errors.push_back(
        {1.0 / intervals, std::abs(solution.objective / problem->cost_scale() - problem->card().reference->objective)});
  }
  const auto fitted = fit_order(errors);
  if (!fitted) return fmt::format("The cost of the beam by {}: too few grids are solved to fit an order.\n", method);
  return fmt::format(
      "The cost of the beam by {}: order {:.3f} ± {:.3f}, fitted over {} grids from N = {:.0f} to {:.0f}.\n", method,
      fitted->order, fitted->standard_error, fitted->points, 1.0 / fitted->last_abscissa, 1.0 / fitted->first_abscissa);
}

/// The published rows of these problems, of all if none is named. Lines that begin with # are words about them. Throws
/// `Error` if a problem has none.
std::vector<Row> published_rows(const std::filesystem::path& file, const std::vector<std::string>& problems) {
  std::string text = read_file(file);
  while (text.starts_with('#')) text.erase(0, text.find('\n') + 1);
  std::vector<Row> rows = Table::from_csv(text).rows();
  for (const std::string& problem : problems) {
    if (std::ranges::none_of(rows, [&](const Row& row) { return row.text("problem") == problem; })) {
      throw Error(fmt::format("--problem: there is no published time of {} in {}", problem, file.string()));
    }
  }
  std::erase_if(rows, [&](const Row& row) {
    return !problems.empty() && std::ranges::find(problems, row.text("problem")) == problems.end();
  });
  for (Row& row : rows) row.set("where", row.text("machine").starts_with("GPU") ? "gpu" : "elsewhere");
  return rows;
}

constexpr const char* words_of_page =
    "Rows that name a source were measured elsewhere, on other machines, by other discretisations and to other "
    "tolerances; they are divided by nothing. Ours: `interior_point`, tolerance 1e-10, medians with their 99 % "
    "intervals (bootstrap), the time of the solver without making the program, which has a column. A solve of less "
    "than 0.1 s is timed the second time in a row, with its memory in the caches. `cost off`: from the problem's "
    "reference, as a share of it.\n\n";

/// A column that both kinds of rows have by this name. Fields that nobody states are empty.
Column<Row> field(const std::string& name, const std::string& unit, const std::string& meaning,
                  FieldKind kind = FieldKind::text) {
  return {name, unit, meaning, FieldReader<Row>([name](const Row& row) { return Cell(row.text(name)); }, {kind})};
}

const Columns<Row>& columns_of_times() {
  static const Columns<Row> columns{
      field("position", "", "of the problem and number of intervals in figures, from 1", FieldKind::integer),
      field("problem", "", "name of the problem"),
      field("intervals", "", "number of intervals N", FieldKind::integer),
      field("who", "", "has solved it: others' software, or our method with its stages and start"),
      field("where", "", "here, elsewhere, or gpu: elsewhere on a graphics processor"),
      field("machine", "", "on which it was solved"),
      field("rounds", "", "how often we solved it", FieldKind::integer),
      field("seconds", "s", "of a solve, ours the median over the rounds", FieldKind::number),
      field("seconds_lower", "s", "of the interval of 99 % of this median", FieldKind::number),
      field("seconds_upper", "s", "of the same interval", FieldKind::number),
      field("setup_seconds", "s", "making our program, which `seconds` leaves out", FieldKind::number),
      field("iterations", "", "of the solver", FieldKind::integer),
      field("objective", "cost", "of the answer", FieldKind::number),
      field("cost_error", "", "by how much the cost is off the problem's reference, as a share", FieldKind::number),
      field("status", "", "how the solve ended, in the words of who has solved it"),
      field("tolerance", "", "of others' solves", FieldKind::number),
      field("differs", "", "what differs from our program"),
      field("source", "", "where it is published")};
  return columns;
}

/// The rows of others and of us, those of one problem and number of intervals beside each other.
Table times_beside_ours(const std::vector<Row>& others, const std::vector<std::unique_ptr<TimedRival>>& ours) {
  Table table = table_of(columns_of_times(), std::vector<Row>());
  const auto are_beside = [](const Row& row, const Row& other) {
    return row.text("problem") == other.text("problem") && row.text("intervals") == other.text("intervals");
  };
  int position = 0;
  const Row* first = nullptr;  // of those beside each other
  for (const Row& other : others) {
    if (first != nullptr && are_beside(*first, other)) continue;
    first = &other;
    ++position;
    const auto take = [&](Row row) {
      if (!are_beside(row, other)) return;
      row.set("position", position);
      set_cost_error(row);
      table.append(std::move(row));
    };
    for (const Row& row : others) take(row);
    for (const auto& rival : ours) take(rival->row());
  }
  return table;
}

std::string table_on_page(const Table& table) {
  return page_table(table.rows(), {{"problem", "problem"},
                                   {"intervals", "N", 9},
                                   {"who", "by"},
                                   {"machine", "on"},
                                   {"seconds", "seconds"},
                                   {"seconds_lower", "from"},
                                   {"seconds_upper", "to"},
                                   {"smallest_seconds", "smallest"},
                                   {"setup_seconds", "making"},
                                   {"iterations", "iterations", 9},
                                   {"objective", "cost", 10},
                                   {"cost_error", "cost off", 2},
                                   {"status", "status"},
                                   {"differs", "what differs"},
                                   {"source", "source"}});
}

/// Where the published times are, and which of them count.
struct Choices {
  std::filesystem::path published = "bench/speed/published.csv";
  std::vector<std::string> problems;
  int threads = static_cast<int>(thread_count());
};

MeasuredPage measure(const Choices& choices, int rounds) {
  const std::vector<Row> others = published_rows(choices.published, choices.problems);
  const auto is_asked_for = [&](const std::string& problem) {
    return std::ranges::any_of(others, [&](const Row& other) { return other.text("problem") == problem; });
  };
  set_thread_count(static_cast<std::size_t>(choices.threads));
  std::vector<std::unique_ptr<TimedRival>> ours;
  for (const OwnSolve& solve : own_solves()) {
    if (is_asked_for(solve.problem)) ours.push_back(std::make_unique<TimedRival>(solve));
  }
  for (int round = 0; round < rounds; ++round) {
    for (const auto& rival : ours) rival->solve();
  }
  const Table table = times_beside_ours(others, ours);
  std::string text = words_of_page + table_on_page(table);
  if (is_asked_for("beam")) {
    for (const char* method : {"dmoc", "hamiltonian"}) text += order_of_beam(method) + "\n";
  }
  return {"Published times beside ours", text, {{"", table}}};
}

}  // namespace

int run_published(int argc, char** argv) {
  Choices choices;
  const PageProgram program{.name = "published",
                            .description = "Times that others have published beside ours on this machine.",
                            .columns = describe(columns_of_times()),
                            .options =
                                [&](CommandLine& line) {
                                  line.option("--published", choices.published, "the table of published times");
                                  line.list("--problem", choices.problems, "problems of that table; none: all of them");
                                  line.number("--threads", choices.threads, 1, 1024, "threads of a solve");
                                },
                            .measure = [&](int rounds) { return measure(choices, rounds); }};
  return program.run(argc, argv);
}

}  // namespace dmocbench::speed

int main(int argc, char** argv) { return dmocbench::speed::run_published(argc, argv); }
