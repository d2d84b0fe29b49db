#include "bench/experiment/command_line.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace dmocbench {

namespace {

constexpr int exit_bad_input = 2;

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

int report_error(const CLI::App& app, const std::string& sentence) {
  fmt::print(stderr, "{}: {}\n", app.get_name(), one_line(sentence));
  return exit_bad_input;
}

}  // namespace

CommandLine::CommandLine(const std::string& description, const std::string& name)
    : parser_(std::make_unique<CLI::App>(description, name)) {}

CommandLine::~CommandLine() = default;

CommandLine::Option& CommandLine::Option::comma_separated() {
  option_.delimiter(',');
  return *this;
}

template <class Number>
CommandLine::Option& CommandLine::Option::range(Number least, Number largest) {
  option_.check(CLI::Range(least, largest));
  return *this;
}
template CommandLine::Option& CommandLine::Option::range(int, int);
template CommandLine::Option& CommandLine::Option::range(long long, long long);
template CommandLine::Option& CommandLine::Option::range(double, double);

CommandLine::Option& CommandLine::Option::required() {
  option_.required();
  return *this;
}

CommandLine::Option& CommandLine::Option::shows_default() {
  option_.capture_default_str();
  return *this;
}

template <class Value>
CommandLine::Option CommandLine::option(const std::string& names, Value& value, const std::string& help) {
  return Option(*parser_->add_option(names, value, help));
}
template CommandLine::Option CommandLine::option(const std::string&, int&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, long long&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, std::uint64_t&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, double&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, std::string&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, std::filesystem::path&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, std::vector<int>&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, std::vector<std::string>&, const std::string&);

void CommandLine::flag(const std::string& names, bool& value, const std::string& help) {
  parser_->add_flag(names, value, help);
}

void CommandLine::footer(const std::string& text) { parser_->footer(text); }

int run_program(CommandLine& line, int argc, char** argv, const std::function<int()>& body) {
  CLI::App& app = *line.parser_;
  try {
    app.parse(argc, argv);
    return body();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);  // --help
    return report_error(app, std::string(error.what()) + "; --help lists the options");
  } catch (const std::exception& error) {
    return report_error(app, error.what());
  }
}

}  // namespace dmocbench
