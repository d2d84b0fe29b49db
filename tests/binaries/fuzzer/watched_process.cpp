#include "tests/binaries/fuzzer/watched_process.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dmocbench::tests {

namespace {

/// In the child, where only simple calls are safe: other threads may have held any lock.
[[noreturn]] void become(const char* binary, char* const* arguments, const char* folder, const char* out,
                         const char* err) {
  setpgid(0, 0);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_DFL);  // a script may ignore them
  const rlimit memory{.rlim_cur = 4UL << 30U, .rlim_max = 4UL << 30U};
  const rlimit core{.rlim_cur = 0, .rlim_max = 0};
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CORE, &core);
  constexpr int mode = 0600;
  const int nothing = open("/dev/null", O_RDONLY);  // NOLINT(*-pro-type-vararg): as POSIX declares it
  const bool ready =
      chdir(folder) == 0 && dup2(nothing, 0) == 0 && dup2(creat(out, mode), 1) == 1 && dup2(creat(err, mode), 2) == 2;
  if (ready) execv(binary, arguments);
  _exit(127);
}

bool ends_within(pid_t child, int& status, double seconds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  return true;
}

}  // namespace

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Ended run_watched(const std::filesystem::path& binary, const std::vector<std::string>& arguments,
                  const std::filesystem::path& folder, const std::filesystem::path& streams, double limit) {
  std::vector<std::string> words = {binary.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const std::string out = streams.string() + ".out";
  const std::string err = streams.string() + ".err";

  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process can be made");
  if (child == 0) become(binary.c_str(), pointers.data(), folder.c_str(), out.c_str(), err.c_str());
  Ended ended;
  int status = 0;
  if (!ends_within(child, status, limit)) {
    ended.was_interrupted = true;
    kill(-child, SIGINT);
    if (!ends_within(child, status, 5.0)) {
      ended.was_killed = true;
      kill(-child, SIGKILL);
      waitpid(child, &status, 0);
    }
  }
  for (int i = 0; i < 200 && kill(-child, 0) == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ended.left_processes = kill(-child, SIGKILL) == 0;  // two seconds to be gone
  if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status);
  if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
  ended.output = text_of(out);
  ended.error = text_of(err);
  return ended;
}

namespace fs = std::filesystem;

namespace {

/// As many fields in every record as in the first, quotes closed, the last line ended.
bool is_whole_table(const std::string& text) {
  std::set<std::size_t> widths;
  std::size_t width = 1;
  bool quoted = false;
  for (const char letter : text) {
    if (letter == '"') quoted = !quoted;
    if (quoted) continue;
    width += static_cast<std::size_t>(letter == ',');
    if (letter == '\n') {
      widths.insert(width);
      width = 1;
    }
  }
  return !quoted && widths.size() == 1 && text.ends_with('\n');
}

/// The paths that a line names as places to write to, as they stand; "results" without any.
std::vector<std::string> places_of(const std::vector<std::string>& line) {
  std::vector<std::string> places = {"results"};
  for (const std::string name : {"--out", "--trace", "--store", "--to"}) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i].starts_with(name + "=")) places.push_back(line[i].substr(name.size() + 1));
      if (line[i] == name && i + 1 < line.size()) places.push_back(line[i + 1]);
      const bool is_model = name == "--to" && line[i].starts_with(name) && places.back().ends_with(".nl");
      if (!is_model) continue;
      const std::string stub = places.back().substr(0, places.back().size() - 3);
      places.insert(places.end(), {stub + ".row", stub + ".col"});
    }
  }
  for (std::string& place : places) place = fs::path(place).lexically_normal().string();
  return places;
}

bool is_within(const std::string& path, const std::vector<std::string>& places) {
  return std::ranges::any_of(places, [&](const std::string& place) {
    return place == "." || path == place || path.starts_with(place + "/") || place.starts_with(path + "/");
  });
}

/// .NAME.PID, as files are called while they are written.
bool is_temporary(const std::string& name) {
  const std::size_t digits = name.size() - name.find_last_not_of("0123456789") - 1;
  return name.starts_with('.') && digits > 0 && digits < name.size() && name[name.size() - digits - 1] == '.';
}

bool is_written_whole(const std::string& path, const std::string& text) {
  if (path.ends_with(".csv")) return is_whole_table(text);
  if (path.ends_with(".json")) return nlohmann::json::accept(text);
  return true;
}

void judge_end(const Ended& ended, std::vector<std::string>& faults) {
  if (ended.was_killed) {
    faults.emplace_back("does not hear an interrupt");
  } else if (ended.signal != 0) {
    faults.push_back(fmt::format("ended by signal {} ({})", ended.signal, strsignal(ended.signal)));
  } else if (std::ranges::count(std::array{0, 1, 2, 130}, ended.code) == 0) {
    faults.push_back(fmt::format("exit code {}", ended.code));
  }
  if (ended.left_processes) faults.emplace_back("leaves a process behind");
  if (ended.code == 2) {
    const auto lines = std::ranges::count(ended.error, '\n');
    if (lines != 1 || !ended.error.ends_with('\n')) faults.push_back(fmt::format("{} lines on standard error", lines));
    if (ended.error.size() > 20000) faults.emplace_back("more than 20000 characters on standard error");
  }
  const auto is_control = [](char letter) { return (letter >= 0 && letter < ' ' && letter != '\n') || letter == 127; };
  if (std::ranges::any_of(ended.error, is_control)) faults.emplace_back("control characters on standard error");
  if (std::ranges::any_of(ended.output, is_control)) faults.emplace_back("control characters on standard output");
  for (const char* raw : {"std::", "json.exception", "basic_filebuf", "basic_string", "vector::", "bad_alloc",
                          "what():", "Resource temporarily", "stod", "regex_"}) {
    if (ended.error.find(raw) != std::string::npos) faults.push_back(fmt::format("the words of a library, {}", raw));
  }
}

/// The options that were given a number which is not written as one, but for those that name files.
void judge_numbers(const std::vector<std::string>& line, const Ended& ended, std::vector<std::string>& faults) {
  if (ended.code != 0) return;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::size_t equals = std::min(line[i].find('='), line[i].size());
    const std::string name = line[i].substr(0, equals);
    const bool is_joined = equals < line[i].size();
    if (!name.starts_with("--") || (!is_joined && i + 1 == line.size())) continue;
    const std::string value = is_joined ? line[i].substr(equals + 1) : line[i + 1];
    const bool names_file = std::ranges::count(std::array{"--name", "--out", "--to", "--store", "--trace"}, name) > 0;
    if (value == "0x10" && !names_file) faults.push_back("takes 0x10 for " + name);
  }
}

}  // namespace

Content content_of(const fs::path& folder) {
  Content content;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const bool is_file = !entry.is_symlink() && entry.is_regular_file();
    content[entry.path().lexically_relative(folder).string()] = is_file ? text_of(entry.path()) : "/";
  }
  return content;
}

std::vector<std::string> faults_of(const std::vector<std::string>& line, const Ended& ended, const Content& before,
                                   const Content& after) {
  std::vector<std::string> faults;
  judge_end(ended, faults);
  judge_numbers(line, ended, faults);
  const std::vector<std::string> places = places_of(line);
  for (const auto& [path, text] : before) {
    const auto now = after.find(path);
    if (now == after.end()) {
      faults.push_back("removes " + path);
    } else if (now->second != text && !is_within(path, places)) {
      faults.push_back("changes " + path);
    }
  }
  for (const auto& [path, text] : after) {
    if (before.contains(path)) continue;
    const std::string name = fs::path(path).filename().string();
    if (ended.code == 2) faults.push_back("refuses, but leaves " + path);
    if (!is_within(path, places)) faults.push_back("writes elsewhere: " + path);
    if (name.find("_part_") != std::string::npos) faults.push_back("leaves a part: " + path);
    if (text == "/") continue;
    if (is_temporary(name)) faults.push_back("leaves a temporary file: " + path);
    if (!is_written_whole(path, text)) faults.push_back("half-written: " + path);
  }
  return faults;
}

}  // namespace dmocbench::tests
