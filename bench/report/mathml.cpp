#include "bench/report/mathml.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "methods/expression/schedule.hpp"

namespace dmocbench {

namespace {

using Place = std::uint32_t;

/// A factor of a product with its exponent.
struct Factor {
  Place base = 0;
  double exponent = 1.0;
};

struct Product {
  double coefficient = 1.0;
  std::vector<Factor> factors;
};

constexpr std::array<std::pair<Operation, std::string_view>, 14> functions{
    {{Operation::exponential, "exp"},
     {Operation::logarithm, "ln"},
     {Operation::sine, "sin"},
     {Operation::cosine, "cos"},
     {Operation::tangent, "tan"},
     {Operation::arc_sine, "arcsin"},
     {Operation::arc_cosine, "arccos"},
     {Operation::arc_tangent, "arctan"},
     {Operation::arc_tangent2, "atan2"},
     {Operation::hyperbolic_sine, "sinh"},
     {Operation::hyperbolic_cosine, "cosh"},
     {Operation::hyperbolic_tangent, "tanh"},
     {Operation::error_function, "erf"},
     {Operation::inverse_hyperbolic_sine, "arsinh"}}};

std::string_view name_of_function(Operation operation) {
  if (operation == Operation::unit_step) return "θ";  // Heaviside's
  const auto* const found = std::ranges::find(functions, operation, &decltype(functions)::value_type::first);
  return found == functions.end() ? "" : found->second;
}

/// Brackets as high as their content, but no higher than letters where that is one line.
std::string in_brackets(const std::string& content) {
  const bool is_high = content.find("<mfrac>") != std::string::npos || content.find("<msqrt>") != std::string::npos;
  const std::string_view bracket = is_high ? "<mo>" : "<mo stretchy=\"false\">";
  return fmt::format("{0}(</mo>{1}{0})</mo>", bracket, content);
}
std::string as_row(const std::string& content) { return "<mrow>" + content + "</mrow>"; }
constexpr std::string_view times = "<mo>\u2062</mo>";
constexpr std::string_view times_after_word = "<mo>·</mo>";
constexpr std::string_view of = "<mo>\u2061</mo>";

std::string joined(const MathTerms& terms) {
  std::string row;
  for (const std::string& term : terms) row += term;
  return row;
}

/// Writes the steps of a schedule.
class Typesetter {
 public:
  Typesetter(const Schedule& schedule, const std::vector<std::string>& inputs, std::size_t parameters)
      : steps_(schedule.steps()), inputs_(inputs), parameters_(parameters), names_(steps_.size()) {
    for (const Schedule::Step& step : steps_) {
      const std::size_t count = operand_count(step.operation);
      std::size_t order = count > 0 ? orders_[step.left] : last_order;
      if (count > 1) order = std::min(order, orders_[step.right]);
      if (step.operation == Operation::input)
        order = step.input_index + (step.input_index < parameters_ ? inputs_.size() : 0);
      orders_.push_back(order);
    }
  }

  /// Names the parts that several others read and that are long.
  TypesetFormulas typeset(const std::vector<Place>& outputs, std::string_view shared_name) {
    const std::vector<std::size_t> readers = count_readers(outputs);
    std::vector<std::size_t> sizes(steps_.size());  // letters and numbers
    TypesetFormulas result;
    for (Place place = 0; place < steps_.size(); ++place) {
      const Schedule::Step& step = steps_[place];
      const std::size_t count = operand_count(step.operation);
      sizes[place] = (count > 0 ? sizes[step.left] : 1) + (count == 1 ? 1 : 0);
      if (count > 1 && !is_square(step)) sizes[place] += sizes[step.right];
      // A part that is itself a formula is written out again, unless it is so long that its readers would outgrow all
      // bounds.
      constexpr std::size_t long_enough = 7;
      const bool is_output = std::ranges::count(outputs, place) > 0;
      if (readers[place] < 2 || sizes[place] < (is_output ? 20 * long_enough : long_enough)) continue;
      const std::string name =
          fmt::format("<msub>{}<mn>{}</mn></msub>", mathml_of_name(shared_name), result.shared.size() + 1);
      result.shared.emplace_back(name, terms(place));
      names_[place] = name;
      sizes[place] = 1;
    }
    for (const Place output : outputs) result.formulas.push_back(terms(output));
    return result;
  }

 private:
  static constexpr std::size_t last_order = std::numeric_limits<std::size_t>::max();

  /// The number of steps and formulas that read each one.
  [[nodiscard]] std::vector<std::size_t> count_readers(const std::vector<Place>& outputs) const {
    std::vector<std::size_t> readers(steps_.size());
    for (const Schedule::Step& step : steps_) {
      const std::size_t count = operand_count(step.operation);
      if (count > 0) ++readers[step.left];
      if (count > 1 && !is_square(step)) ++readers[step.right];
    }
    for (const Place output : outputs) ++readers[output];
    return readers;
  }

  /// A step that reads one operand twice and writes it once.
  static bool is_square(const Schedule::Step& step) {
    return step.operation == Operation::multiply && step.left == step.right;
  }

  [[nodiscard]] bool is_named(Place place) const { return !names_[place].empty(); }

  /// Parameters come first, then variables, then sums, and functions last.
  [[nodiscard]] int rank(Place place) const {
    const Schedule::Step& step = steps_[place];
    if (step.operation == Operation::input) return step.input_index < parameters_ ? 0 : 1;
    return is_named(place) || name_of_function(step.operation).empty() ? 2 : 3;
  }

  /// The terms of a step, each with its sign: added terms before subtracted ones, both in the order of the variables. A
  /// part with a name is one term, unless it is the step itself.
  [[nodiscard]] MathTerms terms(Place place) const {
    std::vector<Product> products;
    add_terms(place, 1.0, true, products);
    std::ranges::stable_sort(products, {}, [this](const Product& product) {
      std::size_t order = last_order;
      for (const Factor& factor : product.factors) order = std::min(order, orders_[factor.base]);
      return std::pair(std::signbit(product.coefficient), order);
    });
    MathTerms written_terms;
    for (Product& product : products) {
      const std::string_view sign = std::signbit(product.coefficient) ? "−" : "+";
      product.coefficient = std::abs(product.coefficient);
      std::string mark;
      if (!written_terms.empty()) mark = fmt::format("<mo form=\"infix\">{}</mo>", sign);
      if (written_terms.empty() && sign == "−") mark = "<mo>−</mo>";
      written_terms.push_back(mark + written(std::move(product)));
    }
    return written_terms;
  }

  void add_terms(Place place, double sign, bool is_whole, std::vector<Product>& products) const {
    const Schedule::Step& step = steps_[place];
    if (is_whole || !is_named(place)) {
      if (step.operation == Operation::add || step.operation == Operation::subtract) {
        add_terms(step.left, sign, false, products);
        add_terms(step.right, step.operation == Operation::add ? sign : -sign, false, products);
        return;
      }
      if (step.operation == Operation::negate) return add_terms(step.left, -sign, false, products);
    }
    Product product{.coefficient = sign, .factors = {}};
    multiply(place, 1.0, is_whole, product);
    products.push_back(std::move(product));
  }

  /// Multiplies by a step to a power; the exponent is 1 or -1, or even where there are squares.
  void multiply(Place place, double exponent, bool is_whole, Product& product) const {
    const Schedule::Step& step = steps_[place];
    switch (is_named(place) && !is_whole ? Operation::input : step.operation) {
      case Operation::multiply:
        // Walked once, or else every operation of repeated squaring would double the walk.
        if (is_square(step)) return multiply(step.left, 2.0 * exponent, false, product);
        multiply(step.left, exponent, false, product);
        return multiply(step.right, exponent, false, product);
      case Operation::divide:
        multiply(step.left, exponent, false, product);
        return multiply(step.right, -exponent, false, product);
      case Operation::reciprocal:
        return multiply(step.left, -exponent, false, product);
      case Operation::negate:
        if (exponent == 1.0 || exponent == -1.0) product.coefficient = -product.coefficient;
        return multiply(step.left, exponent, false, product);
      case Operation::constant:
        if (exponent > 0.0) product.coefficient *= std::pow(step.value, exponent);
        if (exponent < 0.0) product.coefficient /= std::pow(step.value, -exponent);
        return;
      default:
        break;
    }
    const bool is_power = step.operation == Operation::power && (is_whole || !is_named(place));
    const Factor factor = is_power ? Factor{step.left, exponent * step.value} : Factor{place, exponent};
    const auto same = std::ranges::find(product.factors, factor.base, &Factor::base);
    if (same == product.factors.end()) {
      product.factors.push_back(factor);
    } else {
      same->exponent += factor.exponent;
    }
  }

  /// A product whose coefficient is not negative.
  [[nodiscard]] std::string written(Product product) const {
    std::ranges::stable_sort(product.factors, {}, [this](const Factor& factor) {
      return std::pair(rank(factor.base), orders_[factor.base]);
    });
    std::vector<Factor> above;
    std::vector<Factor> below;
    for (const Factor& factor : product.factors) {
      if (factor.exponent > 0.0) above.push_back(factor);
      if (factor.exponent < 0.0) below.push_back({factor.base, -factor.exponent});
    }
    if (below.empty()) return row_of(product.coefficient, above);
    // A number before the fraction, unless the numerator has no other factor.
    if (above.empty()) return fraction(mathml_of_number(product.coefficient), row_of(1.0, below));
    std::string quotient = fraction(row_of(1.0, above), row_of(1.0, below));
    if (product.coefficient == 1.0) return quotient;
    return mathml_of_number(product.coefficient) + std::string(times) + quotient;
  }

  static std::string fraction(const std::string& above, const std::string& below) {
    return fmt::format("<mfrac>{}{}</mfrac>", as_row(above), as_row(below));
  }

  /// True if a factor is a name of several letters, which would run into the next one.
  [[nodiscard]] bool is_word(const Factor& factor) const {
    if (steps_[factor.base].operation != Operation::input) return false;
    const std::string& name = inputs_[steps_[factor.base].input_index];
    const std::size_t letter = name.find("<mi>") + 4;
    return letter + 1 < name.size() && name[letter] >= 'a' && name[letter] <= 'z' && name[letter + 1] != '<';
  }

  /// A number and factors, side by side. A sum that is alone needs no brackets.
  [[nodiscard]] std::string row_of(double coefficient, const std::vector<Factor>& factors) const {
    if (coefficient == 1.0 && factors.size() == 1 && factors.front().exponent == 1.0)
      return content(factors.front().base);
    std::string row;
    bool is_behind_word = false;
    if (coefficient != 1.0 || factors.empty()) row = mathml_of_number(coefficient);
    for (const Factor& factor : factors) {
      if (!row.empty()) row += is_behind_word || is_word(factor) ? times_after_word : times;
      is_behind_word = is_word(factor);
      row += power_of(factor);
    }
    return row;
  }

  [[nodiscard]] std::string power_of(const Factor& factor) const {
    const Schedule::Step& step = steps_[factor.base];
    const std::string_view function = is_named(factor.base) ? "" : name_of_function(step.operation);
    const bool is_letter = is_named(factor.base) || step.operation == Operation::input;
    if (factor.exponent == 1.0) {
      const bool is_simple = is_letter || !function.empty() || step.operation == Operation::square_root;
      return is_simple ? content(factor.base) : in_brackets(content(factor.base));
    }
    const std::string exponent = mathml_of_number(factor.exponent);
    if (!function.empty() && factor.exponent == std::round(factor.exponent))
      return applied(fmt::format("<msup><mi>{}</mi>{}</msup>", function, exponent), step);
    const std::string base = content(factor.base);
    return fmt::format("<msup>{}{}</msup>", as_row(is_letter ? base : in_brackets(base)), exponent);
  }

  /// A function, which may have an exponent, of the operands of a step.
  [[nodiscard]] std::string applied(const std::string& function, const Schedule::Step& step) const {
    std::string arguments = joined(terms_of_part(step.left));
    if (step.operation == Operation::arc_tangent2) arguments += "<mo>,</mo>" + joined(terms_of_part(step.right));
    return function + std::string(of) + as_row(in_brackets(arguments));
  }

  /// The terms of an operand: its name, where it has one.
  [[nodiscard]] MathTerms terms_of_part(Place place) const {
    return is_named(place) ? MathTerms{names_[place]} : terms(place);
  }

  /// A step without brackets around it.
  [[nodiscard]] std::string content(Place place) const {
    if (is_named(place)) return names_[place];
    const Schedule::Step& step = steps_[place];
    if (step.operation == Operation::input) return inputs_[step.input_index];
    if (step.operation == Operation::square_root)
      return fmt::format("<msqrt>{}</msqrt>", as_row(joined(terms_of_part(step.left))));
    const std::string_view function = name_of_function(step.operation);
    return function.empty() ? joined(terms(place)) : applied(fmt::format("<mi>{}</mi>", function), step);
  }

  const std::vector<Schedule::Step>& steps_;
  const std::vector<std::string>& inputs_;
  std::size_t parameters_;
  std::vector<std::string> names_;   // of the steps that have one
  std::vector<std::size_t> orders_;  // the first variable in each step; parameters come after variables, constants last
};

}  // namespace

TypesetFormulas typeset(std::span<const Expression> formulas, const std::vector<std::string>& inputs,
                        std::size_t parameters, std::string_view shared_name) {
  std::vector<Expression> short_ones(formulas.begin(), formulas.end());
  std::vector<std::pair<std::size_t, std::size_t>> long_ones;  // with their operations
  for (std::size_t i = 0; i < formulas.size(); ++i) {
    const std::size_t operations = Schedule(formulas.subspan(i, 1)).operation_count();
    if (operations <= most_typeset_operations) continue;
    short_ones[i] = {};
    long_ones.emplace_back(i, operations);
  }
  const Schedule schedule(short_ones);
  TypesetFormulas result = Typesetter(schedule, inputs, parameters).typeset(schedule.outputs(), shared_name);
  for (const auto& [i, operations] : long_ones)
    result.formulas[i] = {fmt::format("<mtext>a formula of {} operations</mtext>", operations)};
  return result;
}

}  // namespace dmocbench
