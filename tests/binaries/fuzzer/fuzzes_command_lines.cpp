// Draws command lines from the grammar of every binary and beyond, runs each in a folder of its own, and holds how it
// ends to what is promised: exit codes 0, 1, 2 and 130 only, one line with 2, whole files and none elsewhere. A line
// depends on the seed and its number alone.
#include <algorithm>
#include <atomic>
#include <cctype>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/run/command_line.hpp"
#include "tests/binaries/fuzzer/grammar.hpp"
#include "tests/binaries/fuzzer/watched_process.hpp"

namespace dmocbench::tests {
namespace {

namespace fs = std::filesystem;

struct Settings {
  std::string folder;
  long long lines = 120;
  std::uint64_t seed = 1;
  double limit = 4.0;
  long long only = -1;
};

std::string in_shell(const std::vector<std::string>& line) {
  std::string text;
  for (const std::string& word : line) {
    const bool plain = !word.empty() && std::ranges::all_of(word, [](unsigned char letter) {
      return std::isalnum(letter) != 0 ||
             std::string_view("-_=.,:/+").find(static_cast<char>(letter)) != std::string_view::npos;
    });
    text += plain ? " " + word : " $'";
    if (plain) continue;
    for (const char letter : word) {
      const auto byte = static_cast<unsigned char>(letter);
      if (letter == '\'' || letter == '\\') {
        text += fmt::format("\\{}", letter);
      } else if (byte < ' ' || byte > '~') {
        text += fmt::format("\\x{:02x}", byte);
      } else {
        text += letter;
      }
    }
    text += '\'';
  }
  return text;
}

/// What all tries share.
struct Tally {
  std::mutex guard;
  long long faults = 0;
  std::map<int, long long> codes;
};

void try_line(const Settings& settings, const std::vector<Program>& programs, const fs::path& place, long long number,
              Tally& tally) {
  std::seed_seq mixed{settings.seed, static_cast<std::uint64_t>(number)};
  std::mt19937_64 random(mixed);
  const Program& program = programs[random() % programs.size()];
  const std::vector<std::string> line = draw_line(program, random);
  const fs::path folder = place / std::to_string(number);
  fs::create_directories(folder / "here");
  write_fixtures(folder / "here", place / "start");
  const Content before = content_of(folder / "here");
  const auto begin = std::chrono::steady_clock::now();
  const Ended ended = run_watched(program.binary, line, folder / "here", folder / "stream", settings.limit);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  std::vector<std::string> faults = faults_of(line, ended, before, content_of(folder / "here"));
  if (std::distance(fs::directory_iterator(folder), {}) != 3) faults.emplace_back("writes outside of its folder");

  const std::string name = program.binary.filename().string();
  const std::string command = name + in_shell(line);
  const std::scoped_lock lock(tally.guard);
  ++tally.codes[ended.code];
  if (!faults.empty()) {
    ++tally.faults;
    fmt::print("FAULT in line {}: {}\n  {}\n  code {}, {:.1f} s{}, {}\n", number, fmt::join(faults, "; "), command,
               ended.code, seconds.count(), ended.was_interrupted ? " (interrupted)" : "", ended.error.substr(0, 300));
  } else if (settings.only >= 0) {
    fmt::print("{}\n  code {}, {:.1f} s{}\n{}{}", command, ended.code, seconds.count(),
               ended.was_interrupted ? " (interrupted)" : "", ended.output, ended.error);
  }
  std::fflush(stdout);
  fs::remove_all(folder);
}

int fuzz(const Settings& settings) {
  const fs::path place = fs::temp_directory_path() / fmt::format("fuzzes_command_lines.{}", getpid());
  const fs::path binaries = fs::canonical(settings.folder);
  fs::create_directories(place / "start");
  const Ended solved = run_watched(binaries / "solve",
                                   {"--problem", "double_integrator", "--method", "dmoc", "--start", "guess",
                                    "--intervals", "8", "--name", "start", "--out", "."},
                                   place / "start", place / "stream", 60.0);
  if (solved.code != 0) throw std::runtime_error("no start can be written: " + solved.error);
  const std::vector<Program> programs = read_grammar(binaries);

  setenv("DMOCBENCH_THREADS", "1", 1);
  Tally tally;
  const long long first = settings.only >= 0 ? settings.only : 0;
  const long long end = settings.only >= 0 ? settings.only + 1 : settings.lines;
  std::atomic<long long> next = first;
  std::vector<std::jthread> workers;
  for (unsigned i = 0; i < std::min(2U, std::thread::hardware_concurrency()); ++i) {
    workers.emplace_back([&] {
      for (long long number = next++; number < end; number = next++) {
        try_line(settings, programs, place, number, tally);
      }
    });
  }
  workers.clear();
  fs::remove_all(place);
  fmt::print("{} lines of seed {}, exit codes", end - first, settings.seed);
  for (const auto& [code, count] : tally.codes) fmt::print(" {}: {}", code, count);
  fmt::print("; {} at fault\n", tally.faults);
  return tally.faults > 0 ? 1 : 0;
}

}  // namespace
}  // namespace dmocbench::tests

int main(int argc, char** argv) {
  return dmocbench::run_program(
      "fuzzes_command_lines", "Draws command lines for every binary of a folder and judges how each ends.", argc, argv,
      [](dmocbench::CommandLine& line) {
        dmocbench::tests::Settings settings;
        line.option("folder", settings.folder, "of the binaries");
        line.number("--lines", settings.lines, 1, 1000000, "command lines to draw");
        line.number("--seed", settings.seed, 0, 4294967295, "lines depend on it and their number alone");
        line.number("--limit", settings.limit, 0.1, 600.0, "seconds until a line is interrupted");
        line.number("--only", settings.only, -1, 1000000, "the number of the one line to run");
        line.parse();
        return dmocbench::tests::fuzz(settings);
      });
}
