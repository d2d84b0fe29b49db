#include "methods/mechanics/parameter_scope.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

std::string Parameter::range() const {
  return fmt::format("{} in [{:g}, {:g}]", whole ? "a whole number" : "a number", lower, upper);
}

void Parameter::check(double candidate) const {
  const bool in_range = std::isfinite(candidate) && candidate >= lower && candidate <= upper;
  if (in_range && (!whole || candidate == std::trunc(candidate))) return;
  const std::string in_unit = unit.empty() ? "" : " (" + unit + ")";
  throw Error("parameter {} must be {}{}, got {:g}", name, range(), in_unit, candidate);
}

namespace {

/// The innermost scope of a thread; null outside of all scopes.
ParameterScope*& innermost() {
  thread_local ParameterScope* scope = nullptr;
  return scope;
}

Eigen::VectorXd checked(const Problem& problem, Eigen::VectorXd values) {
  const std::vector<Parameter>& parameters = problem.parameters();
  if (static_cast<std::size_t>(values.size()) != parameters.size()) {
    throw Error("{} has {}, got {}", problem.name(), counted(parameters.size(), "parameter"),
                counted(values.size(), "value"));
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) parameters[i].check(values[static_cast<Eigen::Index>(i)]);
  return values;
}

Eigen::VectorXd values_of_part(const Problem& whole, const Problem& part) {
  const Eigen::VectorXd all = parameter_values(whole);
  Eigen::VectorXd values(static_cast<Eigen::Index>(part.parameters().size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    values[i] =
        all[static_cast<Eigen::Index>(parameter_number(whole, part.parameters()[static_cast<std::size_t>(i)].name))];
  }
  return values;
}

}  // namespace

ParameterScope::ParameterScope(const Problem& problem, Eigen::VectorXd values)
    : parameters_(problem.parameters()),
      values_(checked(problem, std::move(values))),
      outer_(std::exchange(innermost(), this)) {}

ParameterScope::~ParameterScope() { innermost() = outer_; }

ParameterScope* ParameterScope::of(const Problem& problem) noexcept {
  ParameterScope* scope = innermost();
  while (scope != nullptr && &scope->parameters_ != &problem.parameters()) scope = scope->outer_;
  return scope;
}

std::optional<std::size_t> ParameterScope::read_varying(std::size_t /*parameter*/) { return std::nullopt; }

void ParameterScope::read_as_number(std::size_t /*parameter*/) {}

SharedParameters::SharedParameters(const Problem& whole, const Problem& part)
    : ParameterScope(part, values_of_part(whole, part)), whole_(ParameterScope::of(whole)) {
  for (const Parameter& parameter : part.parameters()) numbers_.push_back(parameter_number(whole, parameter.name));
}

std::optional<std::size_t> SharedParameters::read_varying(std::size_t parameter) {
  return whole_ == nullptr ? std::nullopt : whole_->read_varying(numbers_[parameter]);
}

void SharedParameters::read_as_number(std::size_t parameter) {
  if (whole_ != nullptr) whole_->read_as_number(numbers_[parameter]);
}

ParameterTrace::ParameterTrace(const Problem& problem, const std::vector<std::string>& open)
    : ParameterScope(problem, parameter_values(problem)),
      problem_(problem),
      varies_(problem.parameters().size(), false),
      is_number_(problem.parameters().size(), false) {
  std::vector<std::string> names = open;
  for (const std::size_t unknown : problem.unknowns()) names.push_back(problem.parameters()[unknown].name);
  for (const std::string& name : names) {
    const std::size_t number = parameter_number(problem, name);
    if (problem.parameters()[number].whole) {
      throw Error("{}: the parameter {} is a whole number and cannot be kept open", problem.name(), name);
    }
    const bool is_open = std::ranges::find(open_, number) != open_.end();
    if (is_open && problem.parameters()[number].is_unknown) {
      throw Error("{}: the unknown {} is determined by the solve and cannot be set", problem.name(), name);
    }
    if (is_open) {
      throw Error("{}: the parameter {} is listed twice among the open parameters", problem.name(), name);
    }
    open_.push_back(number);
  }
}

std::optional<std::size_t> ParameterTrace::read_varying(std::size_t parameter) {
  varies_[parameter] = true;
  const auto found = std::ranges::find(open_, parameter);
  if (found == open_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - open_.begin());
}

void ParameterTrace::read_as_number(std::size_t parameter) {
  is_number_[parameter] = true;
  if (std::ranges::find(open_, parameter) == open_.end()) return;
  const auto& [name, is_unknown] =
      std::pair(problem_.parameters()[parameter].name, problem_.parameters()[parameter].is_unknown);
  if (is_unknown) {
    throw Error("{}: a formula reads the unknown {} as a number, with {}; use {}", problem_.name(), name,
                member_name("parameter()"), member_name("varying()"));
  }
  throw Error("{}: the parameter {} cannot be kept open, because a formula reads it with {}; use {}", problem_.name(),
              name, member_name("parameter()"), member_name("varying()"));
}

void ParameterTrace::require_unknowns_read() const {
  for (const std::size_t unknown : problem_.unknowns()) {
    if (varies_[unknown]) continue;
    throw Error("{}: no formula depends on the unknown {}; remove it", problem_.name(),
                problem_.parameters()[unknown].name);
  }
}

std::vector<bool> ParameterTrace::are_constants() const {
  std::vector<bool> constants = is_number_;
  for (std::size_t i = 0; i < constants.size(); ++i) {
    if (varies_[i] && std::ranges::find(open_, i) == open_.end()) constants[i] = true;
  }
  return constants;
}

std::vector<bool> ParameterTrace::are_varying() const {
  std::vector<bool> varying = varies_;
  for (std::size_t i = 0; i < varying.size(); ++i) {
    const Parameter& parameter = problem_.parameters()[i];
    if (is_number_[i] || parameter.whole || parameter.is_unknown) varying[i] = false;
  }
  return varying;
}

ParameterScope with_unknowns(const Problem& problem, const Eigen::VectorXd& values) {
  Eigen::VectorXd all = parameter_values(problem);
  const std::vector<std::size_t> unknowns = problem.unknowns();
  for (std::size_t i = 0; i < unknowns.size() && static_cast<Eigen::Index>(i) < values.size(); ++i) {
    const Parameter& parameter = problem.parameters()[unknowns[i]];
    all[static_cast<Eigen::Index>(unknowns[i])] =
        std::clamp(values[static_cast<Eigen::Index>(i)], parameter.lower, parameter.upper);
  }
  return {problem, std::move(all)};
}

Eigen::VectorXd parameter_values(const Problem& problem) {
  const std::vector<Parameter>& parameters = problem.parameters();
  const ParameterScope* const scope = ParameterScope::of(problem);
  Eigen::VectorXd values(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    values[static_cast<Eigen::Index>(i)] = scope != nullptr ? scope->value(i) : parameters[i].value;
  }
  return values;
}

std::size_t parameter_number(const Problem& problem, std::string_view name) {
  const std::vector<Parameter>& parameters = problem.parameters();
  const auto found = std::ranges::find(parameters, name, &Parameter::name);
  if (found != parameters.end()) return static_cast<std::size_t>(found - parameters.begin());
  return position_of(parameters, &Parameter::name, name, problem.name() + " has no parameter");  // throws
}

Problem::Problem(std::vector<Parameter> parameters) : parameters_(std::move(parameters)) {
  for (const Parameter& parameter : parameters_) {
    const auto is_same = [&](const Parameter& other) { return other.name == parameter.name; };
    if (std::ranges::count_if(parameters_, is_same) > 1) throw Error("two parameters are named " + parameter.name);
    parameter.check(parameter.value);
    defaults_.push_back(parameter.value);
  }
}

double Problem::parameter(std::string_view name) const {
  const std::size_t number = parameter_number(*this, name);
  ParameterScope* const scope = ParameterScope::of(*this);
  if (scope == nullptr) return parameters()[number].value;
  scope->read_as_number(number);
  return scope->value(number);
}

Expression Problem::varying(std::string_view name) const {
  const std::size_t number = parameter_number(*this, name);
  ParameterScope* const scope = ParameterScope::of(*this);
  if (scope == nullptr) return {parameters()[number].value};
  const auto input = scope->read_varying(number);
  return input ? Expression::input(*input) : Expression(scope->value(number));
}

std::vector<std::size_t> Problem::unknowns() const {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < parameters().size(); ++i) {
    if (parameters()[i].is_unknown) numbers.push_back(i);
  }
  return numbers;
}

void Problem::set_parameter(std::string_view name, double value) {
  const std::size_t number = parameter_number(*this, name);
  if (&parameters() != &parameters_)
    throw Error(this->name() + " uses the parameters of another problem; set them on that problem");
  Parameter& parameter = parameters_[number];
  parameter.check(value);
  parameter.value = value;
}

std::string Problem::settings() const {
  std::string text;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const auto& [name, value] = std::pair(parameters_[i].name, parameters_[i].value);
    if (value != defaults_[i]) text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, value);
  }
  return text;
}

bool Problem::has_default_parameters(std::initializer_list<std::string_view> except) const {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const bool excepted = std::ranges::find(except, parameters_[i].name) != except.end();
    if (!excepted && parameters_[i].value != defaults_[i]) return false;
  }
  return true;
}

}  // namespace dmocbench
