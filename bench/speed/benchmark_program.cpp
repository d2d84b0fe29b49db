#include "bench/speed/benchmark_program.hpp"

#include <exception>
#include <filesystem>
#include <sstream>

#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/command_line.hpp"
#include "bench/run/metadata.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/table_run.hpp"
#include "methods/error.hpp"
#include "methods/runtime/environment.hpp"

namespace dmocbench::speed {

namespace {

/// Prints a line per benchmark, the median of its repetitions, and keeps all of them as JSON.
class Reporter final : public benchmark::ConsoleReporter {
 public:
  Reporter() : ConsoleReporter(OO_None) { json_.SetOutputStream(&text_); }

  // NOLINTBEGIN(readability-identifier-naming): the names of the base class
  bool ReportContext(const Context& context) override {
    return json_.ReportContext(context) && ConsoleReporter::ReportContext(context);
  }
  void ReportRuns(const std::vector<Run>& runs) override {
    json_.ReportRuns(runs);
    std::vector<Run> shown;
    for (const Run& run : runs) {
      if (run.repetitions > 1 && run.aggregate_name != "median" && !run.error_occurred) continue;
      Run& line = shown.emplace_back(run);
      line.report_label.clear();  // the name has the same words
      // The console takes every inverse rate for seconds; a counter that names its unit is printed as a plain number.
      for (auto& [name, counter] : line.counters) {
        if ((counter.flags & benchmark::Counter::kInvert) != 0) counter.flags = benchmark::Counter::kDefaults;
      }
    }
    if (!shown.empty()) ConsoleReporter::ReportRuns(shown);
    GetOutputStream().flush();  // hours may pass until the next
  }
  void Finalize() override {
    json_.Finalize();
    ConsoleReporter::Finalize();
  }
  // NOLINTEND(readability-identifier-naming)

  /// Empty if no benchmark ran.
  [[nodiscard]] Benchmarks benchmarks() const {
    return text_.str().empty() ? Benchmarks{} : parse_benchmarks(text_.str(), "the result of this run");
  }

 private:
  std::ostringstream text_;
  benchmark::JSONReporter json_;
};

/// False if a flag is unknown; the library has then reported it.
bool initialize(const BenchmarkProgram& program, const char* file, const std::vector<std::string>& flags) {
  static std::vector<std::string> arguments;  // the library keeps a pointer to the program's name
  arguments = {file, "--benchmark_repetitions=5", "--benchmark_min_time=0.05",
               "--benchmark_enable_random_interleaving=true", "--benchmark_filter=" + program.default_filter};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  pointers.push_back(nullptr);
  benchmark::Initialize(&count, pointers.data());
  return !benchmark::ReportUnrecognizedArguments(count, pointers.data());
}

/// Runs the benchmarks chosen by the flags and writes their tables. False if no benchmark is chosen; the library has
/// then reported it.
bool run_and_write(const BenchmarkProgram& program, const std::filesystem::path& csv,
                   const std::vector<std::string>& command_line) {
  const nlohmann::ordered_json description = describe_run({});
  for (const char* key : {"commit", "compiler", "flags", "instruction_set", "processor"}) {
    benchmark::AddCustomContext(key, description.at(key).get<std::string>());
  }
  program.register_benchmarks();
  Reporter reporter;
  const bool has_run = benchmark::RunSpecifiedBenchmarks(&reporter) > 0;
  benchmark::Shutdown();
  const Benchmarks benchmarks = reporter.benchmarks();
  if (csv.empty() || benchmarks.empty()) return has_run;
  const auto beside = [&](const std::string& end) {
    return std::filesystem::path(csv).replace_filename(csv.stem().string() + end);
  };
  std::vector<TableFile> tables;
  for (const auto& [suffix, table] : program.tables(benchmarks)) {
    tables.push_back({beside(suffix + csv.extension().string()), table});
  }
  write_tables(tables, beside("_tables.json"), command_line);
  return has_run;
}

}  // namespace

int BenchmarkProgram::run(int argc, char** argv) const try {
  CLI::App app(description + " All flags of Google Benchmark hold as well:", name);
  std::filesystem::path file;
  if (tables) app.add_option("--csv", file, csv)->option_text("FILE");
  app.allow_extras();
  std::vector<std::string> flags;
  try {
    app.parse(argc, argv);
    flags = app.remaining();
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}\n", app.help());
    flags = {"--help"};  // the library adds its own and ends the program
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "{}: {}; --help lists the flags\n", name, error.what());
    return 2;
  }
  check_environment();
  order_by_one_thread();
  if (!initialize(*this, *argv, flags)) return 2;
  if (!file.empty()) require_writable(file);  // before anything is timed
  for (const std::string& flag : flags) {
    if (flag.starts_with("--benchmark_repetitions=-")) throw Error(flag + ": repetitions are at least 1");
  }
  return run_and_write(*this, file, {argv, argv + argc}) ? 0 : 2;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}: {}\n", name, sentence_of(error));
  return 2;
}

benchmark::internal::Benchmark* add_benchmark(const std::string& name, benchmark::TimeUnit unit,
                                              const std::function<void(benchmark::State&)>& run) {
  const auto run_or_tell = [run](benchmark::State& state) {
    try {
      run(state);
    } catch (const Error& error) {
      state.SkipWithError(error.what());
    }
  };
  return benchmark::RegisterBenchmark(name.c_str(), run_or_tell)->UseManualTime()->Unit(unit);
}

}  // namespace dmocbench::speed
