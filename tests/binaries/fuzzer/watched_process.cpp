#include "tests/binaries/fuzzer/watched_process.hpp"

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
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

}  // namespace dmocbench::tests
