#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "methods/runtime/clock.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the name is CLI11's
class App;
class Option;
}  // namespace CLI

namespace dmocbench {

/// What an option changes. Runs whose options of the role `result` are equal write equal rows but for times.
enum class OptionRole : std::uint8_t {
  result,   ///< the rows
  place,    ///< where files are read and written
  machine,  ///< how a machine does the work, and what it prints
};

/// The options of a program: their names, the variables that take their values, and their help, which shows the values
/// that these variables have at first.
///
/// It is implemented with CLI11, in command_line.cpp alone, because its headers take longer to compile than most
/// programs.
class CommandLine {
 public:
  /// Reads into `value`: int, double, string, path, and a vector of strings (the option may be repeated). A name
  /// without dashes names a required positional argument.
  template <class Value>
  void option(const std::string& names, Value& value, const std::string& help, OptionRole role = OptionRole::result);
  /// Reads a number between `least` and `largest`: int, long long, std::uint64_t or double.
  template <class Number>
  void number(const std::string& names, Number& value, std::type_identity_t<Number> least,
              std::type_identity_t<Number> largest, const std::string& help, OptionRole role = OptionRole::result);
  /// Reads values with commas between them: int or string.
  template <class Value>
  void list(const std::string& names, std::vector<Value>& values, const std::string& help);
  /// `names` as in "--polish,!--no-polish", where an exclamation mark precedes a negating name.
  void flag(const std::string& names, bool& value, const std::string& help, OptionRole role = OptionRole::result);
  /// The group of `--help` that options belong to from here on.
  void group(const std::string& name) { group_ = name; }
  /// For an option that some runs do not follow: where it is given and `is_followed` returns false once all options are
  /// read, a `remark` states that it is ignored, and the reason.
  void ignored_unless(const std::string& name, std::function<bool()> is_followed, const std::string& reason);
  /// Text after the options in `--help`.
  void footer(const std::string& text) { footer_ = text; }
  /// The options of a call that `--help` shows as an example; without one it shows the name of the program alone.
  void example(const std::string& options) { example_ = options; }
  /// The meaning of exit code 1 in `--help`; empty for a program that does not return it.
  void exit_code_1(const std::string& meaning) { meaning_of_1_ = meaning; }
  /// The values are known from here on; the name of the program and all its arguments. Throws as `check_environment`.
  std::vector<std::string> parse();
  /// After `parse`: the options that change rows and their values as text, including defaults, by name.
  [[nodiscard]] std::map<std::string, std::string> values_for_results() const;

 private:
  friend int run_program(const std::string& name, const std::string& description, int argc, char** argv,
                         const std::function<int(CommandLine&)>& body);
  /// One option of `ignored_unless`.
  struct Condition {
    std::string name;
    std::function<bool()> is_followed;
    std::string reason;
  };
  /// Takes note of an option's role.
  void note(const CLI::Option* option, OptionRole role);
  CommandLine(CLI::App& app, int argc, char** argv) : app_(app), argc_(argc), argv_(argv) {}
  /// Throws if a list has an empty entry between two commas, which CLI11 drops silently, and if an option has no value
  /// after =.
  void refuse_empty_entries() const;

  /// The text after the options in `--help`.
  [[nodiscard]] std::string end_of_help() const;

  CLI::App& app_;
  int argc_;
  char** argv_;
  std::string group_ = "Options";
  std::string footer_;
  std::string example_;
  std::string meaning_of_1_ = "a row could not be measured";
  std::vector<std::string> lists_;               ///< options with commas between their values
  std::vector<const CLI::Option*> for_results_;  ///< options that change rows
  std::vector<Condition> conditions_;
};

/// The groups of `--help` that most programs have: which problem, and where results go.
inline constexpr const char* group_of_problem = "Problem";
inline constexpr const char* group_of_output = "Output";  ///< where results go

/// A text of any origin for one line of a terminal: blanks in the place of control characters, cut at 2000 bytes.
[[nodiscard]] std::string one_line(std::string_view text);

/// A user's text in quotes, fit for a line on a terminal: cut short, without control characters.
[[nodiscard]] std::string as_shown(std::string_view text);

/// Prints `one_line` of a text, and ends the line.
void print_line(const std::string& text);

/// Notes a sentence about an option that the running program does not follow as given. The program prints it on
/// standard error at its end, with its name in front, unless it ends with an error. An empty sentence is not printed.
void remark(const std::string& sentence);

/// Runs a program: `body` declares its options, parses them and returns the exit code. Every error becomes one line on
/// standard error, with the program's `name` in front, and exit code 2, as does standard output that cannot be written;
/// `Interrupted` gives 130.
int run_program(const std::string& name, const std::string& description, int argc, char** argv,
                const std::function<int(CommandLine&)>& body);

/// For a program within another one: as long as it exists, the sentences by which `run_program` reports errors go to
/// `complaint` and not to standard error; null leaves them there.
class ComplaintScope {
 public:
  /// From now on, until it is destroyed.
  explicit ComplaintScope(std::string* complaint);
  ~ComplaintScope();
  ComplaintScope(const ComplaintScope&) = delete;
  ComplaintScope& operator=(const ComplaintScope&) = delete;

 private:
  std::string* outer_;
};

/// Progress on standard error: on a terminal one line that is replaced, and erased at the end; in a pipe or
/// a file at most one line per minute.
class ProgressLine {
 public:
  /// `program`: its name, in front of lines in a pipe. A silent one shows nothing.
  explicit ProgressLine(std::string program, bool is_silent = false);

  /// Whether a terminal shows it.
  [[nodiscard]] bool is_shown() const noexcept { return terminal_ != nullptr; }
  /// Shows an activity.
  void show(const std::string& activity);
  /// Shows an activity with the number of finished cases and an estimate of the remaining time.
  void show(const std::string& activity, std::size_t done, std::size_t all);

 private:
  std::string program_;
  bool is_silent_;
  std::unique_ptr<std::FILE, void (*)(std::FILE*)> terminal_;  ///< empty if it is not a terminal
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_line_ = begin_;   ///< in a pipe
  std::optional<std::size_t> first_done_;  ///< cases that were finished when the first one was shown
};

/// "40 s", "3 min", "2 h 5 min".
[[nodiscard]] std::string rounded_duration(double seconds);

}  // namespace dmocbench
