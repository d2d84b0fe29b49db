#pragma once

#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace dmocbench::tests {

/// An option as `--help` shows it.
struct Option {
  std::string name;             ///< with its dashes
  std::string type;             ///< TEXT, INT, UINT, FLOAT; empty for a flag
  std::optional<double> least;  ///< of a number with a range
  std::optional<double> largest;
  std::vector<std::string> values;  ///< valid ones: the defaults, and what `list` or we know of
};

/// A binary and what its command line takes.
struct Program {
  std::filesystem::path binary;
  std::vector<Option> options;
};

/// Every binary of a folder with its grammar, from `--help` and from `list`, by name. Throws if one shows none.
[[nodiscard]] std::vector<Program> read_grammar(const std::filesystem::path& folder);

/// The files that drawn lines speak of, written into a folder; `start` is the folder of a motion that solve has
/// written.
void write_fixtures(const std::filesystem::path& folder, const std::filesystem::path& start);

/// A command line without the binary's name, valid or hostile; what it leaves out is set so that a valid one is short.
[[nodiscard]] std::vector<std::string> draw_line(const Program& program, std::mt19937_64& random);

}  // namespace dmocbench::tests
