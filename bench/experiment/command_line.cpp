#include "bench/experiment/command_line.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace dmocbench {

namespace {

template <class Value>
CLI::Option* add(CLI::App& app, const std::string& names, Value& value, const std::string& help) {
  CLI::Option* option = app.add_option(names, value, help)->capture_default_str();
  return option->get_default_str() == "[]" ? option->default_str("") : option;
}

int report_error(const std::string& name, std::string sentence) {
  // One line that no terminal obeys, whatever was typed.
  std::ranges::replace_if(
      sentence, [](unsigned char letter) { return letter < ' ' || letter == 0x7f; }, ' ');
  fmt::print(stderr, "{}: {}\n", name, sentence);
  return 2;
}

}  // namespace

template <class Value>
void CommandLine::option(const std::string& names, Value& value, const std::string& help) {
  add(app_, names, value, help)->required(!names.starts_with('-'));
}
template void CommandLine::option(const std::string&, int&, const std::string&);
template void CommandLine::option(const std::string&, double&, const std::string&);
template void CommandLine::option(const std::string&, std::string&, const std::string&);
template void CommandLine::option(const std::string&, std::filesystem::path&, const std::string&);
template void CommandLine::option(const std::string&, std::vector<std::string>&, const std::string&);

template <class Number>
void CommandLine::number(const std::string& names, Number& value, std::type_identity_t<Number> least,
                         std::type_identity_t<Number> largest, const std::string& help) {
  using Limit = std::conditional_t<std::is_floating_point_v<Number>, double, long long>;
  add(app_, names, value, help)->check(CLI::Range(static_cast<Limit>(least), static_cast<Limit>(largest)));
}
template void CommandLine::number(const std::string&, int&, int, int, const std::string&);
template void CommandLine::number(const std::string&, long long&, long long, long long, const std::string&);
template void CommandLine::number(const std::string&, std::uint64_t&, std::uint64_t, std::uint64_t, const std::string&);
template void CommandLine::number(const std::string&, double&, double, double, const std::string&);

template <class Value>
void CommandLine::list(const std::string& names, std::vector<Value>& values, const std::string& help) {
  add(app_, names, values, help)->delimiter(',');
}
template void CommandLine::list(const std::string&, std::vector<int>&, const std::string&);
template void CommandLine::list(const std::string&, std::vector<std::string>&, const std::string&);

void CommandLine::flag(const std::string& names, bool& value, const std::string& help) {
  app_.add_flag(names, value, help);
}

void CommandLine::footer(const std::string& text) { app_.footer(text); }

std::vector<std::string> CommandLine::parse() {
  app_.parse(argc_, argv_);
  return {argv_, argv_ + argc_};
}

int run_program(const std::string& name, const std::string& description, int argc, char** argv,
                const std::function<int(CommandLine&)>& body) {
  CLI::App app(description, name);
  try {
    CommandLine line(app, argc, argv);
    return body(line);
  } catch (const CLI::Success& request) {  // --help
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    return report_error(name, std::string(error.what()) + "; --help lists the options");
  } catch (const std::exception& error) {
    return report_error(name, error.what());
  }
}

}  // namespace dmocbench
