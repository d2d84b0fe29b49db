#include "tests/binaries/fuzzer/grammar.hpp"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

#include <unistd.h>

#include "tests/binaries/fuzzer/watched_process.hpp"

namespace dmocbench::tests {

namespace fs = std::filesystem;

namespace {

using Values = std::map<std::string, std::vector<std::string>>;

/// What an option takes beyond its defaults and the names of `list`. No path leads out of the folder of a try.
const Values& known_values() {
  static const Values values = {
      {"--constraints", {"multipliers", "embedding", "multipliers,embedding"}},
      {"--controls", {"stage", "shared"}},
      {"--crash", {"none", "all", "boundary"}},
      {"--factorisation", {"intervals", "sparse"}},
      {"--fit", {"4:16", "8:8", "16:4", "4:"}},
      {"--form", {"bolza", "mayer"}},
      {"--grid", {"grid.txt", "bad_grid.txt", "narrow.txt", "file", "folder", "dangling"}},
      {"--intervals", {"2", "4", "8", "4,8", "2:32", "16,4,16", "3", "8:4", "16,", "1,2"}},
      {"--from", {"results", "folder", "none", "file", "."}},
      {"--name", {"table", "a b", ".", "..", ".hidden", "-dash", "x.csv", "other/place"}},
      {"--join", {"results", "folder", "none", "file"}},
      {"--library", {"folder", "none", "file", "dangling"}},
      {"--option",
       {"max_iter=3", "factorisation=sparse", "factorisation=magic", "nosuch=1", "tol=nan", "=", "x=", "tol"}},
      {"--out", {"results", "out", "deep/er", "a b", "folder", "file", "file/inner", "dangling"}},
      {"--part", {"1/1", "1/2", "2/2", "7/9", "0/4", "5/4", "a/b", "1/"}},
      {"--reference", {"64", "indirect", "next", "0"}},
      {"--routes", {"gauss1", "gauss2,lobatto3", "gauss3,gauss3", "gauss03", "lobatto1", "gauss"}},
      {"--start", {"guess", "common", "start_nodes.csv", "torn_nodes.csv", "folder", "file", "none_nodes.csv"}},
      {"--tolerance", {"1e-6", "1e-12", "0.5", "1e-17"}},
      {"--sol", {"file", "none", "folder", "dangling"}},
      {"--roadmap", {"file", "none", "folder", "dangling"}},
      {"--store", {"roadmap.json", "out/roadmap.json", "folder", "file/inner"}},
      {"--to", {"report.html", "program.nl", "out/program.nl", "folder", "file/inner", "file/inner.nl", "dangling"}},
      {"--trace", {"trace.csv", "out/trace.csv", "folder", "file/inner"}},
  };
  return values;
}

/// Words that no option wants, or few. "\xff" is no UTF-8, "٣" a digit of another script.
const std::vector<std::string>& hostile_words() {
  static const std::vector<std::string> words = {"",
                                                 "nan",
                                                 "-nan",
                                                 "inf",
                                                 "-inf",
                                                 "1e999",
                                                 "-1e999",
                                                 "-1",
                                                 "0",
                                                 "-0",
                                                 "1e308",
                                                 "1e-320",
                                                 "0x10",
                                                 "1e5x",
                                                 "99999999999999999999",
                                                 "1,5",
                                                 ",",
                                                 ",,",
                                                 ":",
                                                 "=",
                                                 "a=b",
                                                 "\xff",
                                                 "\x01",
                                                 "\x1b[31mred",
                                                 "two\nlines",
                                                 "tab\there",
                                                 "`touch run`",
                                                 "$(touch run)",
                                                 "'",
                                                 "\"",
                                                 "\\",
                                                 "a'b\"c",
                                                 "é",
                                                 "٣",
                                                 "🚀",
                                                 " ",
                                                 "  x ",
                                                 "%s%n",
                                                 "*",
                                                 "~",
                                                 "-",
                                                 "--",
                                                 "-x",
                                                 "all",
                                                 "none",
                                                 "magic",
                                                 "true",
                                                 "{}",
                                                 "null",
                                                 std::string(300, 'x'),
                                                 std::string(5000, '1')};
  return words;
}

std::string capture(const fs::path& binary, const std::vector<std::string>& arguments) {
  const fs::path place = fs::temp_directory_path() / ("grammar." + std::to_string(getpid()));
  fs::create_directories(place);
  const Ended ended = run_watched(binary, arguments, place, place / "streams", 60.0);
  fs::remove_all(place);
  if (ended.code != 0) throw std::runtime_error(binary.string() + " fails: " + ended.error);
  return ended.output;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

void append(std::vector<std::string>& values, const std::vector<std::string>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

/// The names that `list` shows, by option; of --set the parameters with their default and an odd value.
Values read_names(const std::string& text) {
  Values names;
  std::string section;
  for (const std::string& line : split(text, '\n')) {
    std::smatch found;
    if (std::regex_match(line, found, std::regex(R"([A-Z]\w+ \((--\w+).*)"))) {
      section = found[1];
    } else if (std::regex_search(line, found, std::regex(R"(^ +--set (\w+)=(\S+))"))) {
      names["--set"].push_back(found[1].str() + "=" + found[2].str());
      for (const char* odd : {"=0", "=-1", "=1e6", "=nan", "="}) names["--set"].push_back(found[1].str() + odd);
    } else if (std::regex_search(line, found, std::regex(R"(^(\w+))")) && !section.empty()) {
      names[section].push_back(found[1]);
    }
  }
  return names;
}

Program read_program(const fs::path& binary, const Values& names) {
  Program program{.binary = binary, .options = {}};
  static const std::regex option(R"(^  (?:-\w,)?(--[a-z-]+)(?:[,{]\S*)?(?: (TEXT|INT|UINT|FLOAT)\S*)?.*)");
  static const std::regex range(R"((?:INT|UINT|FLOAT): (\S+) to ([^= ]+))");
  static const std::regex preset(R"((?:TEXT|INT|FLOAT)=\[?([^\] ]+))");
  for (const std::string& line : split(capture(binary, {"--help"}), '\n')) {
    std::smatch found;
    if (!std::regex_match(line, found, option)) continue;
    Option read{.name = found[1], .type = found[2], .least = {}, .largest = {}, .values = {}};
    if (std::regex_search(line, found, range)) {
      read.least = std::stod(found[1]);
      read.largest = std::stod(found[2]);
    }
    if (std::regex_search(line, found, preset)) append(read.values, split(found[1], ','));
    for (const Values* values : {&known_values(), &names}) {
      const auto known = values->find(read.name);
      if (known != values->end()) append(read.values, known->second);
    }
    // These defaults mean long runs, or files where nobody asked for them.
    if (known_values().contains(read.name)) read.values = known_values().at(read.name);
    program.options.push_back(read);
  }
  if (program.options.empty()) throw std::runtime_error(binary.string() + " shows no options");
  return program;
}

// Drawing.

std::size_t below(std::size_t count, std::mt19937_64& random) { return random() % count; }
bool happens(double probability, std::mt19937_64& random) {
  return static_cast<double>(random() >> 11U) < probability * 0x1p53;
}
const std::string& one_of(const std::vector<std::string>& words, std::mt19937_64& random) {
  return words[below(words.size(), random)];
}

/// A number that the option takes, near its least, so that what it counts is few.
std::string valid_number(const Option& option, std::mt19937_64& random) {
  if (option.type == "FLOAT" && option.least && option.largest) {
    return std::to_string(*option.least +
                          (*option.largest - *option.least) * 1e-3 * static_cast<double>(below(20, random)));
  }
  return std::to_string(static_cast<long long>(option.least.value_or(1.0)) + static_cast<long long>(below(3, random)));
}

std::string draw_value(const Option& option, std::mt19937_64& random) {
  if (happens(0.12, random)) return one_of(hostile_words(), random);
  if (option.values.empty() || option.least) return valid_number(option, random);
  std::string value = one_of(option.values, random);
  if (option.type == "TEXT" && happens(0.1, random)) value += "," + one_of(option.values, random);
  return value;
}

void add(std::vector<std::string>& line, const std::string& name, const std::string& value, bool joined) {
  if (joined) {
    line.push_back(name + "=" + value);
  } else {
    line.insert(line.end(), {name, value});
  }
}

/// What keeps a line short where it does not say otherwise. Problems that take long from their default start are drawn,
/// but are no default.
const Values& tame_values() {
  static const Values values = {
      {"--problem", {"double_integrator", "forced_oscillator", "two_link_manipulator", "orbital_transfer"}},
      {"--intervals", {"8", "12", "16"}},
      {"--iterations", {"40"}},
      {"--repeats", {"1"}},
      {"--seconds", {"2"}},
      {"--starts", {"2"}},
      {"--steps", {"10"}},
      {"--steps-per-period", {"64"}},
      {"--periods", {"10"}},
      {"--method", {"dmoc", "tangent"}},
      {"--start", {"guess"}},
      {"--routes", {"gauss2,lobatto3"}},
      {"--reference", {"64"}},
  };
  return values;
}

}  // namespace

std::vector<Program> read_grammar(const fs::path& folder) {
  const fs::path list = folder / "list";
  const Values names = read_names(capture(list, {"--problem", "all"}) + capture(list, {}));
  std::vector<fs::path> binaries;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const bool executable = (entry.status().permissions() & fs::perms::owner_exec) != fs::perms::none;
    const std::string name = entry.path().filename().string();
    if (name == "new" || name == "study") continue;  // one writes where it stands, the other starts those fuzzed here
    if (entry.is_regular_file() && executable && !entry.path().has_extension()) binaries.push_back(entry.path());
  }
  std::ranges::sort(binaries);
  std::vector<Program> programs;
  programs.reserve(binaries.size());
  for (const fs::path& binary : binaries) programs.push_back(read_program(binary, names));
  return programs;
}

void write_fixtures(const fs::path& folder, const fs::path& start) {
  const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder / name) << text; };
  for (const char* part : {"nodes", "stages"}) {
    fs::copy_file(start / (std::string("start_") + part + ".csv"), folder / (std::string("start_") + part + ".csv"));
  }
  write("torn_nodes.csv", "t,q\n0,1\n0.5");
  write("grid.txt", "0\n0.1\n0.3\n0.6\n0.8\n1\n");
  write("bad_grid.txt", "0\nhalf\nnan\n1\n");
  write("narrow.txt", "0\n0.1\n0.3\n0.30000000000000004\n0.6\n0.8\n1\n");
  write("file", "text\n");
  fs::create_directory(folder / "folder");
  fs::create_symlink("nowhere", folder / "dangling");
}

std::vector<std::string> draw_line(const Program& program, std::mt19937_64& random) {
  std::vector<std::string> line;
  std::vector<std::string> said;
  for (std::size_t count = below(5, random) + 1; count > 0; --count) {
    const Option& option = program.options[below(program.options.size(), random)];
    const bool again = std::ranges::count(said, option.name) > 0;
    if ((again && !happens(0.2, random)) || (option.name == "--help" && !happens(0.1, random))) continue;
    said.push_back(option.name);
    if (option.type.empty()) {
      line.push_back(option.name);
    } else {
      add(line, option.name, draw_value(option, random), happens(0.5, random));
    }
  }
  for (const Option& option : program.options) {
    const auto tame = tame_values().find(option.name);
    if (tame == tame_values().end() || std::ranges::count(said, option.name) > 0) continue;
    add(line, option.name, one_of(tame->second, random), true);
  }
  if (happens(0.03, random)) line.emplace_back("--colour");
  if (happens(0.03, random)) line.push_back(one_of(hostile_words(), random));
  if (happens(0.05, random)) line.push_back(program.options[below(program.options.size(), random)].name);  // no value
  return line;
}

}  // namespace dmocbench::tests
