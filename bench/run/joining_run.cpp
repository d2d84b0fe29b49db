#include "bench/run/joining_run.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "bench/run/json_place.hpp"
#include "bench/run/problem_libraries.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"
#include "methods/runtime/parsed.hpp"

namespace dmocbench {

namespace {

constexpr std::string_view experiments = " " DMOCBENCH_EXPERIMENTS " ";

/// Options of experiments whose values are numbers or known names.
constexpr std::string_view harmless_options =
    " --problem --method --integrator --substeps --tableau --controls --stages --quadrature --points --control-nodes "
    "--solver --derivatives --intervals --set --form --start-seconds --tolerance --tolerances --iterations --seconds "
    "--repeats --verbose --jobs --batch --no-batch --reference --polish --no-polish --fit --routes --no-indirect "
    "--starts --library-starts --seed --amplitude --plane "
    "--hessian --crash --factorisation --over --samples --constraints --condition --fresh "
    "--quiet --json ";

/// Options that `merge` sets itself.
constexpr std::string_view set_by_merge = " --part --out --name ";

/// Options that may name a file to be read, code to be loaded, or an option of a library by which it writes files.
constexpr std::string_view options_with_files = " --library --grid --start --option ";

/// True if a word is in a list that has a space on either side of each word.
bool is_in(std::string_view list, const std::string& word) {
  return word.find(' ') == std::string::npos && list.find(" " + word + " ") != std::string_view::npos;
}

/// An option with its values, as it was given.
struct GivenOption {
  std::string name;
  std::vector<std::string> values;
};

/// The options of the command line in a part. Throws `Error` on a word that belongs to no option.
std::vector<GivenOption> options_of(const PartFile& part) {
  const auto words = JsonPlace(part.description, part.path.string()).at("command_line").texts();
  std::vector<GivenOption> options;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word.starts_with("--")) {
      const std::size_t equals = word.find('=');
      options.push_back({word.substr(0, equals), {}});
      if (equals != std::string::npos) options.back().values.push_back(word.substr(equals + 1));
    } else if (options.empty() || (word.starts_with('-') && !parsed<double>(word))) {
      throw Error(fmt::format("{}: no experiment takes the word \"{}\" of its command line; remove that part",
                              part.path.string(), word));
    } else {
      options.back().values.push_back(word);
    }
  }
  return options;
}

/// True if an option that may name files does not name any.
bool names_no_file(const GivenOption& option) {
  const auto is_harmless = [&option](const std::string& value) {
    if (option.name == "--start") return value == "common" || value == "guess";
    return option.name == "--option" && (value.starts_with("hessian=") || value.starts_with("factorisation="));
  };
  return !option.values.empty() && std::ranges::all_of(option.values, is_harmless);
}

/// The options of a part that a joining run may take over. Throws `Error` if one belongs to no experiment, or if it
/// names a file or the like and is missing from `own`, the options of `merge`.
std::vector<std::string> taken_over(const PartFile& part, const std::vector<GivenOption>& own) {
  std::vector<std::string> words;
  for (const GivenOption& option : options_of(part)) {
    const auto& [name, values] = option;
    const bool may_have_files = is_in(options_with_files, name);
    if (may_have_files && (name == "--library" || std::ranges::count(own, name, &GivenOption::name) > 0)) continue;
    if (is_in(harmless_options, name) || (may_have_files && names_no_file(option))) {
      words.push_back(name);
      words.insert(words.end(), values.begin(), values.end());
    } else if (may_have_files) {
      throw Error(
          fmt::format("{} was made with {} {}; merge accepts this option only from its own command line: if you trust "
                      "the value, add it there",
                      part.path.string(), name, fmt::join(values, " ")));
    } else if (!is_in(set_by_merge, name)) {
      throw Error(fmt::format("{}: no experiment that has parts takes {}; remove that part", part.path.string(), name));
    }
  }
  return words;
}

/// Throws `Error` unless `merge` was given a library of the name of every one that the part was made with.
void require_libraries(const PartFile& part, std::vector<std::string> given) {
  const JsonPlace identity = JsonPlace(part.description, part.path.string()).at("identity");
  if (!identity.has("problem_libraries")) return;
  std::ranges::move(libraries_of_environment(), std::back_inserter(given));
  for (const auto& [name, checksum] : identity.at("problem_libraries").members()) {
    const auto has_name = [&name = name](const std::filesystem::path& file) {
      std::error_code none;  // a missing one is rejected when it is loaded
      return std::filesystem::weakly_canonical(file, none).filename() == name;
    };
    if (std::ranges::any_of(given, has_name)) continue;
    throw Error(
        fmt::format("{} was made with the library of problems {}; merge loads only libraries that it is given: add "
                    "--library with the path on this machine",
                    part.path.string(), name));
  }
}

/// The words that start the experiment that wrote a part.
std::vector<std::string> program_of(const PartFile& part) {
  const std::string experiment = JsonPlace(part.description, part.path.string()).at("identity").at("experiment").text();
  if (!is_in(experiments, experiment)) {
    throw Error(fmt::format("{} was written by \"{}\", which is not an experiment; remove that part",
                            part.path.string(), experiment));
  }
  return start_of_program(experiment);
}

/// The options with files that `merge` was given.
std::vector<GivenOption> own_options(const JoiningOptions& options) {
  std::vector<GivenOption> own;
  const auto add = [&own](const char* name, const std::vector<std::string>& values) {
    for (const std::string& value : values) {
      if (!value.empty()) own.push_back({name, {value}});
    }
  };
  add("--library", options.libraries);
  add("--grid", {options.grid});
  add("--start", {options.start});
  add("--option", options.passed_on);
  return own;
}

}  // namespace

void require_name(const std::string& name, const std::filesystem::path& out) {
  if (!name.empty()) return require_name_of_table(name);
  std::vector<std::string> names;
  std::error_code none;  // a folder that does not exist has no parts
  for (const auto& entry : std::filesystem::directory_iterator(out, none)) {
    if (entry.path().extension() == ".parts") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  throw Error(names.empty() ? fmt::format("--name is missing, and there are no parts in {}", out.string())
                            : fmt::format("--name is missing; in {} there are parts of {}", out.string(),
                                          fmt::join(names, ", ")));
}

std::vector<std::string> start_of_program(const std::string& name) {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  if (self.filename() != "merge" && self.filename() != "study") return {self.string(), name};
  const std::filesystem::path program = self.parent_path() / name;
  if (::access(program.c_str(), X_OK) != 0)
    throw Error(fmt::format("there is no program {}; build it", program.string()));
  return {program.string()};
}

std::vector<std::string> joining_run(const PartFile& part, const JoiningOptions& options) {
  require_libraries(part, options.libraries);
  const std::vector<GivenOption> own = own_options(options);
  std::vector<std::string> command_line = program_of(part);
  std::ranges::move(taken_over(part, own), std::back_inserter(command_line));
  const auto add = [&command_line](const std::string& name, const std::string& value) {
    command_line.insert(command_line.end(), {name, value});
  };
  for (const auto& [name, values] : own) add(name, values.front());
  add("--out", options.out.string());
  add("--name", options.name);
  for (const std::filesystem::path& folder : options.folders) add("--join", folder.string());
  return command_line;
}

void run_in_place(const std::vector<std::string>& command_line) {
  std::vector<char*> words;
  std::vector<std::string> copies = command_line;
  words.reserve(copies.size() + 1);
  for (std::string& word : copies) words.push_back(word.data());
  words.push_back(nullptr);
  std::fflush(nullptr);
  ::execv(words.front(), words.data());
  throw Error(
      fmt::format("cannot run {}: {}", command_line.front(), std::strerror(errno)));  // NOLINT(concurrency-mt-unsafe)
}

}  // namespace dmocbench
