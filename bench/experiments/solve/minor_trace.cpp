#include "bench/experiments/solve/minor_trace.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/described_tables.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// Columns of the quadratic program are named x3 (variable 3 of the program, from 0) or s5 (the slack of constraint 5).
Table trace_table(const std::vector<MinorIteration>& trace, Eigen::Index variables) {
  const auto named = [variables](const std::optional<Eigen::Index> MinorIteration::*column) {
    return [variables, column](const MinorIteration& minor) -> std::string {
      const std::optional<Eigen::Index>& index = minor.*column;
      if (!index) return {};
      return *index < variables ? fmt::format("x{}", *index) : fmt::format("s{}", *index - variables);
    };
  };
  const Columns<MinorIteration> columns{
      {"major", "", "major iteration", &MinorIteration::major},
      {"phase", "", "1 or 2", [](const MinorIteration& minor) { return static_cast<int>(minor.phase); }},
      {"entering", "", "column that enters the basis", named(&MinorIteration::entering)},
      {"leaving", "", "column that leaves the basis", named(&MinorIteration::leaving)},
      {"into_basis", "", "column added to the basis", named(&MinorIteration::into_basis)},
      {"step", "", "length of the step", &MinorIteration::step},
      {"infeasibility", "", "sum of the infeasibilities", &MinorIteration::infeasibility},
      {"objective", "", "scaled objective of the quadratic program", &MinorIteration::objective},
      {"superbasics", "", "number of superbasic columns", &MinorIteration::superbasics},
      {"basic_slacks", "", "number of slacks in the basis", &MinorIteration::basic_slacks},
  };
  return table_of(columns, trace);
}

/// Where a path leads, whether it is there or not.
std::filesystem::path place_of(const std::filesystem::path& path) {
  std::error_code none;  // a missing path has no links to follow
  return std::filesystem::weakly_canonical(std::filesystem::absolute(path), none);
}

bool is_in_folder(const std::filesystem::path& file, const std::filesystem::path& folder) {
  return place_of(file).parent_path() == place_of(folder);
}

}  // namespace

void MinorTrace::add_to(CommandLine& line) {
  line.option("--trace", file_,
              "write this file with a row for every minor iteration of one solve by sqp; the metadata lists the file "
              "if it is in the folder of --out");
}

void MinorTrace::check(const std::vector<Case>& cases, const ExperimentCard& card) const {
  if (!is_wanted()) return;
  if (cases.size() != 1 || cases.front().solver != "sqp") {
    throw Error("--trace needs exactly one case, solved by --solver sqp");
  }
  std::vector<std::string> own = card.further_files;
  own.insert(own.end(), {".csv", ".json"});
  for (const std::string& suffix : own) {
    if (place_of(file_) != place_of(card.options.out / (card.options.name + suffix))) continue;
    throw Error("--trace {} is a file that this run writes; choose another", file_);
  }
  if (!is_in_folder(file_, card.options.out)) require_writable(file_);
}

SolvedCase MinorTrace::solve(const SolveTask& task) {
  SequentialOptions choices = sequential_options(task.named_options);
  choices.on_minor_iteration = [this](const MinorIteration& minor) {
    if (!minors_.empty() && minor.major < minors_.back().major) minors_.clear();  // a repeated solve
    minors_.push_back(minor);
  };
  return task.by(SqpSolver(task.options, std::move(choices)));
}

void MinorTrace::write(const SolvedCase& solved) {
  table_ = trace_table(minors_, static_cast<Eigen::Index>(solved.program ? solved.program->variable_count() : 0));
  write_file(file_, table_.csv());
}

void MinorTrace::describe(FurtherOutput& output) const {
  if (!is_wanted() || !is_in_folder(file_, output.prefix.parent_path())) return;
  note_table(file_, table_, output.metadata);
  output.named_by_user.emplace_back(file_);
}

}  // namespace dmocbench
