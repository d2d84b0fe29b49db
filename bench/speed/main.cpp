// Times of exact derivatives per interval: the tape, the assembled program, formulas written by hand, a replay number
// by number, ADOL-C; and what the machine can do at most.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/speed/benchmarks.hpp"
#include "bench/speed/interval_table.hpp"
#include "bench/speed/machine.hpp"
#include "bench/speed/measurements.hpp"
#include "bench/speed/start_benchmarks.hpp"
#include "bench/speed/summary.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// What a run without flags leaves out, so that it takes a minute: several stages, and the chains of links.
constexpr const char* default_filter = "-gauss_[2-9]|link_chain";

void run(const std::filesystem::path& csv) {
  const std::vector<std::string> problems = paper_problem_names();
  Subjects subjects;
  for (const std::string& problem : problems) {
    subjects.push_back(std::make_unique<Subject>(Formulas{.problem = problem}));
  }
  register_tape_benchmarks(subjects);
  register_program_benchmarks();
  register_hand_benchmarks(subjects);
  register_replay_benchmarks(subjects);
  register_adolc_benchmarks(subjects);
  register_machine_benchmarks();

  CollectingReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  if (!reporter.measurements().empty()) {
    const Table intervals = interval_table(reporter.measurements());
    fmt::print("{}{}", roofline(intervals), summary(reporter.measurements(), problems));
    write_tables(csv, {{"", intervals}, {"_machine", machine_table(reporter.measurements())}});
  }
  benchmark::Shutdown();
}

}  // namespace

}  // namespace dmocbench::speed

int main(int argc, char** argv) {
  using namespace dmocbench::speed;  // NOLINT(google-build-using-namespace): the program's own
  return start({argv, static_cast<std::size_t>(argc)},
               {.name = "speed",
                .description = "Times of exact derivatives per interval.",
                .csv = "write FILE, a row per benchmark, and FILE_machine, what the machine can do",
                .default_filter = default_filter},
               run);
}
