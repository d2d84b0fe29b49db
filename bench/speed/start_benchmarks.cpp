#include "bench/speed/start_benchmarks.hpp"

#include <exception>

#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/experiment/result_file.hpp"
#include "methods/error.hpp"

namespace dmocbench::speed {

namespace {

/// False if there is a flag that nobody knows; the library has then said so.
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

/// Finds out before anything is timed whether the tables can be written. Throws `Error` if not.
void prepare(const std::filesystem::path& file) {
  if (file.empty()) return;
  prepare_folder(file.has_parent_path() ? file.parent_path() : ".");
  if (std::filesystem::is_directory(file)) {
    throw Error(fmt::format("cannot write {}: it is a folder; name a file in it", file.string()));
  }
}

int parse_and_run(std::span<char* const> arguments, const BenchmarkProgram& program,
                  const std::function<void(const std::filesystem::path& csv)>& run) {
  CLI::App app(program.description + " All flags of Google Benchmark hold as well:", program.name);
  std::filesystem::path csv;
  app.add_option("--csv", csv, program.csv)->option_text("FILE");
  app.allow_extras();
  std::vector<std::string> flags;
  try {
    app.parse(static_cast<int>(arguments.size()), arguments.data());
    flags = app.remaining();
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}\n", app.help());
    flags = {"--help"};  // the library adds its own and ends the program
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "{}: {}; --help lists the flags\n", program.name, error.what());
    return 2;
  }
  if (!initialize(program, arguments.front(), flags)) return 2;
  try {
    prepare(csv);
  } catch (const Error& error) {
    fmt::print(stderr, "{}: {}\n", program.name, error.what());
    return 2;
  }
  run(csv);
  return 0;
}

}  // namespace

int start(std::span<char* const> arguments, const BenchmarkProgram& program,
          const std::function<void(const std::filesystem::path& csv)>& run) {
  try {
    return parse_and_run(arguments, program, run);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", program.name, error.what());
    return 1;
  }
}

void write_tables(const std::filesystem::path& csv, const std::vector<std::pair<std::string, Table>>& tables) {
  if (csv.empty()) return;
  for (const auto& [suffix, table] : tables) {
    std::filesystem::path file = csv;
    file.replace_filename(csv.stem().string() + suffix + csv.extension().string());
    write_file(file, table.csv());
  }
}

}  // namespace dmocbench::speed
