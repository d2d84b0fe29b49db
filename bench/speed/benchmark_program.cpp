#include "bench/speed/benchmark_program.hpp"

#include <exception>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/command_line.hpp"
#include "bench/run/error_sentences.hpp"
#include "bench/run/metadata.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"
#include "methods/runtime/environment.hpp"

namespace dmocbench::speed {

namespace {

/// Prints a line per benchmark, the median of its repetitions.
class Reporter final : public benchmark::ConsoleReporter {
 public:
  Reporter() : ConsoleReporter(OO_None) {}

  // NOLINTNEXTLINE(readability-identifier-naming): the name of the base class
  void ReportRuns(const std::vector<Run>& runs) override {
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

/// The file of Google Benchmark states the data needed to judge or repeat its numbers.
void describe(const std::vector<std::string>& command_line) {
  const nlohmann::ordered_json description = describe_run(command_line);
  for (const char* key : {"dmocbench", "commit", "compiler", "flags", "instruction_set", "processor"}) {
    benchmark::AddCustomContext(key, description.at(key).get<std::string>());
  }
  benchmark::AddCustomContext("command_line", description.at("command_line").dump());
}

}  // namespace

int BenchmarkProgram::run(int argc, char** argv) const try {
  const std::vector<std::string> flags(argv + 1, argv + argc);
  for (const std::string& flag : flags) {
    if (flag == "--help") fmt::print("{}: {} The program takes the flags of Google Benchmark:\n\n", name, description);
  }
  check_environment();
  order_by_one_thread();
  if (!initialize(*this, *argv, flags)) return 2;
  for (const std::string& flag : flags) {
    constexpr std::string_view file = "--benchmark_out=";
    if (flag.starts_with(file)) require_writable(flag.substr(file.size()));  // before anything is timed
    if (flag.starts_with("--benchmark_repetitions=-")) throw Error(flag + ": repetitions must be at least 1");
  }
  describe({argv, argv + argc});
  register_benchmarks();
  Reporter reporter;
  const bool has_run = benchmark::RunSpecifiedBenchmarks(&reporter) > 0;  // otherwise the library has reported it
  benchmark::Shutdown();
  return has_run ? 0 : 2;
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
