#include "bench/run/joining_run.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// A command line without some options and their values.
std::vector<std::string> without_places(const std::vector<std::string>& command_line) {
  constexpr std::array places{"--part", "--out", "--name"};
  std::vector<std::string> kept;
  for (std::size_t i = 1; i < command_line.size(); ++i) {
    const std::string& word = command_line[i];
    const auto is_word = [&word](const char* option) { return word == option; };
    const auto is_joined = [&word](const char* option) { return word.starts_with(std::string(option) + "="); };
    if (std::ranges::any_of(places, is_joined)) continue;
    if (std::ranges::any_of(places, is_word)) {
      ++i;  // and its value
    } else {
      kept.push_back(word);
    }
  }
  return kept;
}

/// What starts an experiment: the program of its name beside `merge`, or that one which is all of them.
std::vector<std::string> program_of(const std::string& experiment) {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  if (self.filename() != "merge") return {self.string(), experiment};
  const std::filesystem::path program = self.parent_path() / experiment;
  if (::access(program.c_str(), X_OK) != 0) {
    throw Error(fmt::format("there is no program {}, which wrote the parts; build it", program.string()));
  }
  return {program.string()};
}

}  // namespace

void require_name(const std::string& name, const std::filesystem::path& out) {
  if (!name.empty()) return;
  std::vector<std::string> names;
  std::error_code none;  // a folder that is not there has none
  for (const auto& entry : std::filesystem::directory_iterator(out, none)) {
    if (entry.path().extension() == ".parts") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  throw Error(names.empty() ? fmt::format("--name is missing, and there are no parts in {}", out.string())
                            : fmt::format("--name is missing; in {} there are parts of {}", out.string(),
                                          fmt::join(names, ", ")));
}

std::vector<std::string> joining_run(const PartFile& part, const std::vector<std::filesystem::path>& folders,
                                     const std::filesystem::path& out, const std::string& name) {
  std::vector<std::string> command_line = program_of(part.description.at("identity").at("experiment"));
  for (const std::string& word : without_places(part.description.at("command_line"))) command_line.push_back(word);
  command_line.insert(command_line.end(), {"--out", out.string(), "--name", name});
  for (const std::filesystem::path& folder : folders)
    command_line.insert(command_line.end(), {"--join", folder.string()});
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
