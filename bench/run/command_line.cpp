#include "bench/run/command_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "bench/run/build.hpp"
#include "bench/run/error_sentences.hpp"
#include "bench/run/interrupt.hpp"
#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/runtime/environment.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

namespace {

template <class Value>
CLI::Option* add(CLI::App& app, const std::string& group, const std::string& names, Value& value,
                 const std::string& help) {
  CLI::Option* option = app.add_option(names, value, help)->capture_default_str()->group(group);
  return option->get_default_str() == "[]" ? option->default_str("") : option;
}

/// Where sentences of errors go; null for standard error.
std::string*& complaint_of_thread() {
  thread_local std::string* complaint = nullptr;
  return complaint;
}

/// A program that runs in this thread; Python runs one program within another.
class RunningProgram {
 public:
  explicit RunningProgram(const std::string& name) : name_(name), outer_(std::exchange(innermost(), this)) {}
  ~RunningProgram() { innermost() = outer_; }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// Null outside of programs.
  static RunningProgram*& innermost() {
    thread_local RunningProgram* program = nullptr;
    return program;
  }

  void add(std::string remark) { remarks_.push_back(std::move(remark)); }
  /// Prints the remarks once the command line has been accepted: bad input gets one line, its error.
  void print_remarks() {
    for (const std::string& remark : std::exchange(remarks_, {}))
      static_cast<void>(std::fputs((name_ + ": " + one_line(remark) + "\n").c_str(), stderr));
  }

 private:
  std::string name_;
  RunningProgram* outer_;
  std::vector<std::string> remarks_;
};

int report_error(const std::string& name, const std::string& sentence) {
  if (std::string* const complaint = complaint_of_thread()) {
    *complaint = one_line(sentence);
    return 2;
  }
  // Not by fmt::print, which throws where standard error is closed or full.
  static_cast<void>(std::fputs((name + ": " + one_line(sentence) + "\n").c_str(), stderr));
  return 2;
}

/// Numbers as tables write them: CLI11 takes 0x10 for 16, and blanks.
const CLI::Validator is_written_as_number(
    [](const std::string& text) {
      return parsed<double>(text).has_value() ? std::string() : fmt::format("{} is not a number", text);
    },
    "");

/// Files that are opened must not take the place of standard streams that are closed, or messages would end up in them.
/// Writing to a closed standard output must fail, so /dev/full takes its place.
void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) != -1) continue;
    static_cast<void>(::open(stream == STDOUT_FILENO ? "/dev/full" : "/dev/null", O_RDWR));
  }
}

}  // namespace

ComplaintScope::ComplaintScope(std::string* complaint) : outer_(std::exchange(complaint_of_thread(), complaint)) {}

ComplaintScope::~ComplaintScope() { complaint_of_thread() = outer_; }

std::string one_line(std::string_view text) {
  constexpr std::size_t longest = 2000;
  std::string line(text.substr(0, longest));
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto letter = static_cast<unsigned char>(line[i]);
    const bool is_long_control =  // U+0080 to U+009F
        letter == 0xc2 && i + 1 < line.size() && static_cast<unsigned char>(line[i + 1]) < 0xa0;
    if (is_long_control) line[i + 1] = ' ';
    if (letter < ' ' || letter == 0x7f || is_long_control) line[i] = ' ';
  }
  if (text.size() > longest) line += fmt::format(" ... ({} more bytes)", text.size() - longest);
  return line;
}

void remark(const std::string& sentence) {
  RunningProgram* const program = RunningProgram::innermost();
  if (!sentence.empty() && program != nullptr) program->add(sentence);
}

void print_line(const std::string& text) { fmt::print("{}\n", one_line(text)); }

std::string as_shown(std::string_view text) {
  constexpr std::size_t most_shown = 40;
  std::string shown(text.substr(0, most_shown));
  std::ranges::replace_if(
      shown, [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
  return fmt::format("\"{}\"{}", shown, text.size() > most_shown ? " ..." : "");
}

template <class Value>
void CommandLine::option(const std::string& names, Value& value, const std::string& help, OptionRole role) {
  CLI::Option* const option = add(app_, group_, names, value, help)->required(!names.starts_with('-'));
  note(option, role);
  constexpr bool is_path = std::is_same_v<Value, std::filesystem::path>;
  if constexpr (is_path || std::is_same_v<Value, std::string>) {
    const auto is_empty = [](const std::string& text) {
      return std::string(!text.empty() ? "" : is_path ? "no file or folder is named" : "no file or value is given");
    };
    option->check(CLI::Validator(is_empty, ""));
  }
  if constexpr (std::is_arithmetic_v<Value>) option->check(is_written_as_number);
}
template void CommandLine::option(const std::string&, int&, const std::string&, OptionRole);
template void CommandLine::option(const std::string&, double&, const std::string&, OptionRole);
template void CommandLine::option(const std::string&, std::string&, const std::string&, OptionRole);
template void CommandLine::option(const std::string&, std::filesystem::path&, const std::string&, OptionRole);
template void CommandLine::option(const std::string&, std::vector<std::string>&, const std::string&, OptionRole);

template <class Number>
void CommandLine::number(const std::string& names, Number& value, std::type_identity_t<Number> least,
                         std::type_identity_t<Number> largest, const std::string& help, OptionRole role) {
  using Limit = std::conditional_t<std::is_floating_point_v<Number>, double, long long>;
  const auto nan = [](const std::string& text) {  // which no comparison finds outside of a range
    return std::isnan(std::strtod(text.c_str(), nullptr)) ? fmt::format("{} is not a number", text) : std::string();
  };
  CLI::Option* const option = add(app_, group_, names, value, help);
  note(option, role);
  option->check(is_written_as_number)->check(CLI::Validator(nan, ""));
  CLI::Validator range = CLI::Range(static_cast<Limit>(least), static_cast<Limit>(largest));
  option->check(range.description(fmt::format(" {} to {}", least, largest)));
}
template void CommandLine::number(const std::string&, int&, int, int, const std::string&, OptionRole);
template void CommandLine::number(const std::string&, long long&, long long, long long, const std::string&, OptionRole);
template void CommandLine::number(const std::string&, std::uint64_t&, std::uint64_t, std::uint64_t, const std::string&,
                                  OptionRole);
template void CommandLine::number(const std::string&, double&, double, double, const std::string&, OptionRole);

template <class Value>
void CommandLine::list(const std::string& names, std::vector<Value>& values, const std::string& help) {
  CLI::Option* const option = add(app_, group_, names, values, help)->delimiter(',');
  note(option, OptionRole::result);
  if constexpr (std::is_arithmetic_v<Value>) option->check(is_written_as_number);
  lists_.push_back(names);
}
template void CommandLine::list(const std::string&, std::vector<int>&, const std::string&);
template void CommandLine::list(const std::string&, std::vector<std::string>&, const std::string&);

void CommandLine::refuse_empty_entries() const {
  for (int i = 1; i < argc_; ++i) {
    const std::string argument = argv_[i];
    const std::size_t equals = std::min(argument.find('='), argument.size());
    if (argument.starts_with("--") && equals + 1 == argument.size()) {  // CLI11 takes the next argument for its value
      throw CLI::ValidationError(argument.substr(0, equals), "there is no value after =");
    }
    if (std::ranges::find(lists_, argument.substr(0, equals)) == lists_.end()) continue;
    if (equals == argument.size() && i + 1 == argc_) continue;  // CLI11 misses the value
    const std::string value = equals < argument.size() ? argument.substr(equals + 1) : argv_[i + 1];
    if (value.starts_with(',') || value.ends_with(',') || value.find(",,") != std::string::npos) {
      throw CLI::ValidationError(argument.substr(0, equals), fmt::format("there is an empty entry in {}", value));
    }
  }
}

void CommandLine::flag(const std::string& names, bool& value, const std::string& help, OptionRole role) {
  note(app_.add_flag(names, value, help)->group(group_), role);
}

void CommandLine::ignored_unless(const std::string& name, std::function<bool()> is_followed,
                                 const std::string& reason) {
  conditions_.push_back({name, std::move(is_followed), reason});
}

void CommandLine::note(const CLI::Option* option, OptionRole role) {
  if (role == OptionRole::result) for_results_.push_back(option);
}

std::string CommandLine::end_of_help() const {
  const std::string blank = footer_.empty() ? "" : "\n\n";
  const std::string code_1 = meaning_of_1_.empty() ? "" : fmt::format(" 1 {};", meaning_of_1_);
  const std::string example = example_.empty() ? app_.get_name() : app_.get_name() + " " + example_;
  return fmt::format(
      "{}{}Example:\n  {}\n\nExit codes: 0 done;{} 2 bad input, or a file cannot be read or written; 130 interrupted",
      footer_, blank, example, code_1);
}

std::vector<std::string> CommandLine::parse() {
  refuse_empty_entries();
  app_.footer(end_of_help());
  app_.parse(argc_, argv_);
  check_environment();
  order_by_one_thread();
  for (const auto& [name, is_followed, reason] : conditions_) {
    if (app_.count(name) > 0 && !is_followed()) remark(fmt::format("{} is ignored: {}", name, reason));
  }
  return {argv_, argv_ + argc_};
}

std::map<std::string, std::string> CommandLine::values_for_results() const {
  std::map<std::string, std::string> values;
  for (const CLI::Option* option : for_results_) {
    const bool is_given = option->count() > 0;
    values[option->get_name()] =
        is_given ? fmt::format("{}", fmt::join(option->results(), ",")) : option->get_default_str();
  }
  return values;
}

namespace {

/// Formats options as CLI11 does, without the value that a negating name (`--no-...`) stands for.
class HelpFormatter final : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    std::string name = CLI::Formatter::make_option_name(option, is_positional);
    constexpr std::string_view noise = "{false}";
    for (std::size_t at = name.find(noise); at != std::string::npos; at = name.find(noise))
      name.erase(at, noise.size());
    return name;
  }
};

/// Installed experiments are called as "dmocbench NAME".
std::string name_in_usage(const std::string& name, std::string_view call) {
  const std::size_t slash = call.rfind('/', call.find(' '));
  const std::string_view program = call.substr(slash == std::string_view::npos ? 0 : slash + 1);
  return program == "dmocbench " + name ? std::string(program) : name;
}

/// The mistake in a command line; for a mistyped option also the name that was likely meant.
std::string sentence_of_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  auto unknown = app.remaining();
  if (unknown.size() > 1) std::erase(unknown, "--");
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr || unknown.empty()) return error.what();
  const std::string option = unknown.front().substr(0, unknown.front().find('='));
  std::vector<std::string> names;
  for (const CLI::Option* known : app.get_options()) {
    for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
  }
  if (!option.starts_with('-') && std::ranges::find(names, "--problem") != names.end())
    return fmt::format("{} is not an option; name a problem with --problem {}", as_shown(option), as_shown(option));
  if (!option.starts_with('-') && std::ranges::find(names, "--from") != names.end())
    return fmt::format("{} is not an option; name a results folder with --from {}", as_shown(option), as_shown(option));
  // The letters of formulas, which no option resembles.
  constexpr std::array letters{std::pair("N", "--intervals"), std::pair("n", "--intervals"), std::pair("s", "--stages"),
                               std::pair("T", "--set")};
  std::string meant = option.starts_with("--") ? likely_meant(option, names) : "";
  for (const auto& [letter, name] : letters) {
    const bool is_letter = option == fmt::format("-{}", letter) || option == fmt::format("--{}", letter);
    if (is_letter && std::ranges::find(names, name) != names.end()) meant = name;
  }
  if (!meant.empty()) return fmt::format("there is no option {} (did you mean {}?)", option, meant);
  const bool has_parameters = option.starts_with("--") && std::ranges::find(names, "--set") != names.end();
  if (has_parameters) {
    const bool is_next = unknown.front() == option && unknown.size() > 1 && !unknown[1].starts_with("--");
    const std::string value = is_next ? unknown[1] : unknown.front().substr(option.size());
    return fmt::format("there is no option {}; to set a parameter of the problem, write --set {}={}", option,
                       option.substr(2), value.empty() ? "VALUE" : value.substr(value.starts_with('=') ? 1 : 0));
  }
  return option.starts_with('-') ? fmt::format("there is no option {}", option)
                                 : fmt::format("{} is not an option", as_shown(option));
}

}  // namespace

int run_program(const std::string& name, const std::string& description, int argc, char** argv,
                const std::function<int(CommandLine&)>& body) {
  CLI::App app(description, name_in_usage(name, argc > 0 ? argv[0] : ""));
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_version_flag("-v,--version", "dmocbench " + version(), "show the version and exit")->group("Help");
  app.set_help_flag("-h,--help", "show this help and exit")->group("Help");
  occupy_closed_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows beyond a limit is an error of writing
  std::signal(SIGPIPE, SIG_IGN);  // and so is a pipe without a reader: locks and parts are removed
  RunningProgram program(name);
  try {
    CommandLine line(app, argc, argv);
    const int code = body(line);
    program.print_remarks();
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    return report_error(name, "cannot write to standard output");
  } catch (const CLI::Success& request) {  // --help
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    return report_error(name, sentence_of_parse_error(app, error) + "; --help lists the options");
  } catch (const Interrupted& interrupt) {
    report_error(name, interrupt.what());
    return 130;
  } catch (const Stopped& stop) {
    if (!interrupt_requested()) return report_error(name, stop.what());
    report_error(name, Interrupted().what());
    return 130;
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return report_error(name, "cannot write to standard output");
    const int code = report_error(name, (interrupt_requested() ? "interrupted, and then: " : "") + sentence_of(error));
    return interrupt_requested() ? 130 : code;
  } catch (...) {  // from formulas of other authors
    return report_error(name, "a problem threw an object that is not a std::exception; throw dmocbench::Error");
  }
}

namespace {

void erase_line(std::FILE* terminal) { std::fputs("\r\033[K", terminal); }

}  // namespace

ProgressLine::ProgressLine(std::string program, bool is_silent)
    : program_(std::move(program)),
      is_silent_(is_silent),
      terminal_(!is_silent && ::isatty(STDERR_FILENO) == 1 ? stderr : nullptr, erase_line) {}

void ProgressLine::show(const std::string& activity) {
  constexpr double seconds_between_lines = 60.0;
  if (is_shown()) {
    erase_line(terminal_.get());
    fmt::print(terminal_.get(), "{}", one_line(activity));
    std::fflush(terminal_.get());
  } else if (!is_silent_ && seconds_since(last_line_) >= seconds_between_lines) {
    last_line_ = Clock::now();
    fmt::print(stderr, "{}: {}\n", program_, one_line(activity));
  }
}

void ProgressLine::show(const std::string& activity, std::size_t done, std::size_t all) {
  if (!first_done_) first_done_ = done;
  const auto finished = static_cast<double>(done - *first_done_);
  std::string left;
  if (finished > 0.0) {
    const double seconds = seconds_since(begin_) / finished * static_cast<double>(all - done);
    left = fmt::format(", about {} left", rounded_duration(seconds));
  }
  show(fmt::format("[{}/{}{}] {}", done + 1, all, left, activity));
}

std::string rounded_duration(double seconds) {
  constexpr double minute = 60.0;
  constexpr long long minutes_of_hour = 60;
  if (seconds < 2.0 * minute) return fmt::format("{:.0f} s", seconds);
  const auto minutes = static_cast<long long>(std::round(seconds / minute));
  if (minutes < 2 * minutes_of_hour) return fmt::format("{} min", minutes);
  return fmt::format("{} h {} min", minutes / minutes_of_hour, minutes % minutes_of_hour);
}

}  // namespace dmocbench
