#include "methods/mechanics/column_names.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/mechanics/member_name.hpp"

namespace dmocbench {

namespace {

/// Columns of one table by their names, and whose each is.
class TakenColumns {
 public:
  /// `subject` begins the sentences, "spring: in configuration_names and control_names".
  TakenColumns(std::string subject, const std::string& time) : subject_(std::move(subject)), owners_{{time, ""}} {}

  /// Throws `Error` if the column has no name that a table can have, or one that another has.
  void take(const std::string& column, const std::string& name) {
    const bool has_blank = name.starts_with(' ') || name.ends_with(' ');
    if (name.empty() || has_blank || name.find_first_of(",\"") != std::string::npos || has_control_character(name)) {
      throw Error(
          "{}, \"{}\" cannot name a column: it is empty, or has a comma, a quotation mark, a control "
          "character, or a leading or trailing blank",
          subject_, shown(name));
    }
    const auto [other, is_new] = owners_.try_emplace(column, name);
    if (is_new) return;
    const std::string& owner = other->second;
    std::string fault = fmt::format("and \"{}\" would both name the column {}", owner, column);
    if (owner.empty()) fault = "is the name of the time column";
    if (owner == name) fault = "is used twice";
    throw Error("{}, \"{}\" {}; rename one", subject_, name, fault);
  }

 private:
  static std::string shown(std::string name) {
    const auto is_plain = [](unsigned char letter) { return letter >= ' ' && letter < 0x7f; };
    if (has_control_character(name)) std::ranges::replace_if(name, std::not_fn(is_plain), '?');
    return name;
  }

  std::string subject_;
  std::map<std::string, std::string> owners_;  // by column; the time's has no name
};

}  // namespace

bool has_control_character(std::string_view text) noexcept {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto letter = static_cast<unsigned char>(text[i]);
    const auto before = static_cast<unsigned char>(i > 0 ? text[i - 1] : ' ');
    if (letter < 0x20 || letter == 0x7f) return true;
    if (before == 0xc2 && letter >= 0x80 && letter < 0xa0) return true;  // U+0080 to U+009F
  }
  return false;
}

std::string name_with_unit(const std::string& name, const std::string& unit) {
  std::string word;
  for (const char letter : unit.starts_with("1/") ? unit.substr(1) : unit) {
    if (letter == '/') word += word.empty() ? "per_" : "_per_";
    if (letter == ' ') word += '_';
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0) word += letter;
  }
  return word.empty() ? name : name + "_in_" + word;
}

std::pair<std::string, std::string> name_and_unit(const std::string& column) {
  const std::size_t end = column.rfind("_in_");
  if (end == std::string::npos) return {column, ""};
  return {column.substr(0, end), column.substr(end + 4)};
}

void require_names(const Problem& problem) {
  TakenColumns columns(
      problem.name() + ": in " + member_name("configuration_names") + " and " + member_name("control_names"), "t");
  const auto names_of = [&](const char* function, const auto& call) { return call_formula(problem, function, call); };
  const auto configurations = names_of("configuration_names", [&] { return problem.configuration_names(); });
  const auto controls = names_of("control_names", [&] { return problem.control_names(); });
  if (configurations.empty()) {
    throw Error(problem.name() + ": " + member_name("configuration_names") +
                " is empty; derive a problem with only first-order states from FirstOrderProblem");
  }
  const auto first_order = names_of("first_order_names", [&] { return problem.first_order_names(); });
  for (const std::string& name : configurations) columns.take(name, name);
  for (const std::string& name : first_order) {
    columns.take(name, name);
    columns.take("psi_" + name, name);
  }
  for (const std::size_t unknown : problem.unknowns()) {
    const std::string& name = problem.parameters()[unknown].name;
    columns.take(name, name);
  }
  for (const std::string& name : controls) columns.take(name, name);
  for (const std::string& name : configurations) {
    for (const char* const prefix : {"v_", "p_", "psi_q_", "psi_p_"}) columns.take(prefix + name, name);
  }
}

void require_names(const Problem& problem, const Picture& picture) {
  const std::string time = name_with_unit("t", problem.card().time_unit.name);
  TakenColumns columns(problem.name() + ": in the picture", time);
  for (const PictureQuantity& quantity : picture) {
    if (quantity.name == "t") columns.take(time, "t");
    columns.take(name_with_unit(quantity.name, quantity.unit), quantity.name);
  }
}

}  // namespace dmocbench
