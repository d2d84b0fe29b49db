#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dmocbench::tests {

/// How a process ended.
struct Ended {
  int code = 0;                  ///< exit code, if no signal ended it
  int signal = 0;                ///< the signal that ended it, 0 if none
  bool was_interrupted = false;  ///< it outlived its limit and got SIGINT
  bool was_killed = false;       ///< it did not hear that either
  bool left_processes = false;
  std::string output;
  std::string error;
};

/// Runs a binary in a folder, in a process group of its own, without input; its streams go to files whose names begin
/// with `streams`. After `limit` seconds it gets SIGINT, as from a terminal, and 5 seconds later SIGKILL.
[[nodiscard]] Ended run_watched(const std::filesystem::path& binary, const std::vector<std::string>& arguments,
                                const std::filesystem::path& folder, const std::filesystem::path& streams,
                                double limit);

/// The whole text of a file.
[[nodiscard]] std::string text_of(const std::filesystem::path& file);

/// What stands in a folder: relative paths, with the content of regular files and "/" for anything else.
using Content = std::map<std::string, std::string>;
[[nodiscard]] Content content_of(const std::filesystem::path& folder);

/// What is wrong with how a command line ended and what it left, a sentence each; nothing if all is well.
[[nodiscard]] std::vector<std::string> faults_of(const std::vector<std::string>& line, const Ended& ended,
                                                 const Content& before, const Content& after);

}  // namespace dmocbench::tests
