#pragma once

#include <functional>
#include <memory>
#include <string>

namespace CLI {  // NOLINT(readability-identifier-naming): the name is CLI11's
class App;
class Option;
}  // namespace CLI

namespace dmocbench {

/// The options of a program: names, where their values go, what `--help` says.
///
/// CLI11 stands behind it, in command_line.cpp alone: its headers take a compiler longer than most programs do.
class CommandLine {
 public:
  /// `name` is the program's, in front of every complaint.
  CommandLine(const std::string& description, const std::string& name);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;
  CommandLine(CommandLine&&) = delete;
  CommandLine& operator=(CommandLine&&) = delete;

  /// An option that is registered, to say more about it.
  class Option {
   public:
    /// Values may stand in one argument, with commas between them.
    Option& comma_separated();
    /// The least and the largest value; for int, long long and double.
    template <class Number>
    Option& range(Number least, Number largest);
    /// It has to be given.
    Option& required();
    /// `--help` shows the value as it is now.
    Option& shows_default();

   private:
    friend class CommandLine;
    explicit Option(CLI::Option& option) : option_(option) {}
    CLI::Option& option_;
  };

  /// Reads into `value`: int, long long, std::uint64_t, double, string, path, and vectors of int or string.
  template <class Value>
  Option option(const std::string& names, Value& value, const std::string& help);
  /// `names` as in "--polish,!--no-polish", where what follows an exclamation mark says no.
  void flag(const std::string& names, bool& value, const std::string& help);
  /// What `--help` says behind the options.
  void footer(const std::string& text);

 private:
  friend int run_program(CommandLine& line, int argc, char** argv, const std::function<int()>& body);
  std::unique_ptr<CLI::App> parser_;
};

/// Parses a command line and runs `body`; every error becomes one line on standard error and exit code 2.
int run_program(CommandLine& line, int argc, char** argv, const std::function<int()>& body);

}  // namespace dmocbench
