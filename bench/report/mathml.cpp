#include "bench/report/mathml.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

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

/// The surroundings of a part of a formula, which decide whether it needs brackets.
enum class Around : unsigned char { nothing, factor, base_of_power };

std::string_view name_of_function(Operation operation) {
  switch (operation) {
    case Operation::exponential:
      return "exp";
    case Operation::logarithm:
      return "ln";
    case Operation::sine:
      return "sin";
    case Operation::cosine:
      return "cos";
    case Operation::tangent:
      return "tan";
    case Operation::arc_sine:
      return "arcsin";
    case Operation::arc_cosine:
      return "arccos";
    case Operation::arc_tangent:
      return "arctan";
    case Operation::arc_tangent2:
      return "atan2";
    case Operation::hyperbolic_sine:
      return "sinh";
    case Operation::hyperbolic_cosine:
      return "cosh";
    case Operation::hyperbolic_tangent:
      return "tanh";
    case Operation::inverse_hyperbolic_sine:
      return "arsinh";
    case Operation::error_function:
      return "erf";
    case Operation::unit_step:
      return "θ";  // Heaviside's
    default:
      return "";
  }
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
      : steps_(schedule.steps()), inputs_(inputs), parameters_(parameters), names_(steps_.size()), orders_(orders()) {}

  /// Names the parts that several others read and that are long.
  TypesetFormulas typeset(const std::vector<Place>& outputs, std::string_view shared_name) {
    const std::vector<std::size_t> readers = count_readers(outputs);
    std::vector<std::size_t> sizes(steps_.size());
    TypesetFormulas result;
    for (Place place = 0; place < steps_.size(); ++place) {
      sizes[place] = size_of(place, sizes);
      // A part that is itself a formula is written out again, unless it is so long that its readers would outgrow all
      // bounds.
      const std::size_t enough = is_output(place, outputs) ? 20 * long_enough : long_enough;
      if (readers[place] < 2 || sizes[place] < enough) continue;
      const std::string name =
          fmt::format("<msub>{}<mn>{}</mn></msub>", mathml_of_name(shared_name), result.shared.size() + 1);
      result.shared.emplace_back(name, sum(place));
      names_[place] = name;
      sizes[place] = 1;
    }
    for (const Place output : outputs) result.formulas.push_back(sum(output));
    return result;
  }

 private:
  static constexpr std::size_t long_enough = 7;  // letters and numbers
  static constexpr std::size_t last_order = std::numeric_limits<std::size_t>::max();

  static bool is_output(Place place, const std::vector<Place>& outputs) {
    return std::ranges::find(outputs, place) != outputs.end();
  }

  /// The number of steps that read each one.
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

  [[nodiscard]] std::size_t size_of(Place place, const std::vector<std::size_t>& sizes) const {
    const Schedule::Step& step = steps_[place];
    const std::size_t count = operand_count(step.operation);
    if (count == 0) return 1;
    if (count == 1) return sizes[step.left] + 1;
    return sizes[step.left] + (is_square(step) ? 0 : sizes[step.right]);
  }

  /// A step that reads one operand twice and writes it once.
  static bool is_square(const Schedule::Step& step) {
    return step.operation == Operation::multiply && step.left == step.right;
  }

  [[nodiscard]] bool is_named(Place place) const { return !names_[place].empty(); }
  [[nodiscard]] bool is_constant(Place place) const { return steps_[place].operation == Operation::constant; }

  /// The terms of a step, each with its sign. A part with a name is one term, unless it is the step itself.
  [[nodiscard]] MathTerms sum(Place place) const {
    std::vector<Product> products;
    add_terms(place, 1.0, true, products);
    // Added terms before subtracted ones, both in the order of the variables.
    std::ranges::stable_sort(products, {}, [this](const Product& product) {
      return std::pair(std::signbit(product.coefficient), order_of(product));
    });
    MathTerms terms;
    for (Product& product : products) {
      const bool is_negative = std::signbit(product.coefficient);
      product.coefficient = std::abs(product.coefficient);
      const std::string_view first = is_negative ? "<mo>−</mo>" : "";
      const std::string_view later = is_negative ? "<mo form=\"infix\">−</mo>" : "<mo form=\"infix\">+</mo>";
      const std::string_view sign = terms.empty() ? first : later;
      terms.push_back(std::string(sign) + written(std::move(product)));
    }
    return terms;
  }

  void add_terms(Place place, double sign, bool is_whole, std::vector<Product>& terms) const {
    const Schedule::Step& step = steps_[place];
    if (is_whole || !is_named(place)) {
      if (step.operation == Operation::add || step.operation == Operation::subtract) {
        add_terms(step.left, sign, false, terms);
        add_terms(step.right, step.operation == Operation::add ? sign : -sign, false, terms);
        return;
      }
      if (step.operation == Operation::negate) return add_terms(step.left, -sign, false, terms);
    }
    Product product{.coefficient = sign, .factors = {}};
    if (is_whole) {
      multiply_whole(place, 1.0, product);
    } else {
      multiply(place, 1.0, product);
    }
    terms.push_back(std::move(product));
  }

  /// Multiplies by a step to a power.
  void multiply(Place place, double exponent, Product& product) const {
    if (is_named(place)) return multiply_by_factor(place, exponent, product);
    multiply_whole(place, exponent, product);
  }

  /// The exponent is 1 or -1, or even where there are squares.
  void multiply_whole(Place place, double exponent, Product& product) const {
    const Schedule::Step& step = steps_[place];
    switch (step.operation) {
      case Operation::multiply:
        // Walked once, or else every operation of repeated squaring would double the walk.
        if (is_square(step)) return multiply(step.left, 2.0 * exponent, product);
        multiply(step.left, exponent, product);
        return multiply(step.right, exponent, product);
      case Operation::divide:
        multiply(step.left, exponent, product);
        return multiply(step.right, -exponent, product);
      case Operation::reciprocal:
        return multiply(step.left, -exponent, product);
      case Operation::negate:
        if (exponent == 1.0 || exponent == -1.0) product.coefficient = -product.coefficient;
        return multiply(step.left, exponent, product);
      case Operation::power:
        return multiply_by_factor(step.left, exponent * step.value, product);
      case Operation::constant:
        if (exponent > 0.0) product.coefficient *= std::pow(step.value, exponent);
        if (exponent < 0.0) product.coefficient /= std::pow(step.value, -exponent);
        return;
      default:
        break;
    }
    multiply_by_factor(place, exponent, product);
  }

  static void multiply_by_factor(Place base, double exponent, Product& product) {
    const auto same = std::ranges::find(product.factors, base, &Factor::base);
    if (same == product.factors.end()) {
      product.factors.push_back({base, exponent});
    } else {
      same->exponent += exponent;
    }
  }

  /// Parameters come first, then variables, then sums, and functions last, so that their arguments are clear.
  [[nodiscard]] int rank(const Factor& factor) const {
    const Schedule::Step& step = steps_[factor.base];
    if (step.operation == Operation::input) return step.input_index < parameters_ ? 0 : 1;
    if (is_named(factor.base)) return 2;
    return name_of_function(step.operation).empty() ? 2 : 3;
  }

  /// The smallest number of a variable in a step; parameters come after variables, constants last.
  [[nodiscard]] std::size_t order_of(Place place) const { return orders_[place]; }
  [[nodiscard]] std::size_t order_of(const Product& product) const {
    std::size_t order = last_order;
    for (const Factor& factor : product.factors) order = std::min(order, order_of(factor.base));
    return order;
  }

  [[nodiscard]] std::vector<std::size_t> orders() const {
    std::vector<std::size_t> orders;
    for (const Schedule::Step& step : steps_) {
      std::size_t order = last_order;
      if (step.operation == Operation::input)
        order = step.input_index < parameters_ ? inputs_.size() + step.input_index : step.input_index;
      const std::size_t count = operand_count(step.operation);
      if (count > 0) order = orders[step.left];
      if (count > 1) order = std::min(order, orders[step.right]);
      orders.push_back(order);
    }
    return orders;
  }

  [[nodiscard]] std::string written(Product product) const {
    std::ranges::stable_sort(product.factors, {},
                             [this](const Factor& factor) { return std::pair(rank(factor), order_of(factor.base)); });
    std::vector<Factor> above;
    std::vector<Factor> below;
    for (const Factor& factor : product.factors) {
      if (factor.exponent > 0.0) above.push_back(factor);
      if (factor.exponent < 0.0) below.push_back({factor.base, -factor.exponent});
    }
    if (below.empty()) return row_of(product.coefficient, above);
    // A number before the fraction, unless the numerator has no other factor.
    if (above.empty())
      return fmt::format("<mfrac>{}{}</mfrac>", mathml_of_number(product.coefficient), part_of_fraction(below));
    std::string fraction = fmt::format("<mfrac>{}{}</mfrac>", part_of_fraction(above), part_of_fraction(below));
    if (product.coefficient == 1.0) return fraction;
    return mathml_of_number(product.coefficient) + std::string(times) + fraction;
  }

  /// True if a factor is a name of several letters, which would run into the next one.
  [[nodiscard]] bool is_word(const Factor& factor) const {
    const Schedule::Step& step = steps_[factor.base];
    if (step.operation != Operation::input) return false;
    const std::string& name = inputs_[step.input_index];
    const std::size_t letter = name.find("<mi>") + 4;
    return letter + 1 < name.size() && name[letter] >= 'a' && name[letter] <= 'z' && name[letter + 1] != '<';
  }

  /// A number and factors, side by side.
  [[nodiscard]] std::string row_of(double coefficient, const std::vector<Factor>& factors) const {
    std::string row;
    bool is_behind_word = false;
    if (coefficient != 1.0 || factors.empty()) row = mathml_of_number(coefficient);
    for (const Factor& factor : factors) {
      if (!row.empty()) row += is_behind_word || is_word(factor) ? times_after_word : times;
      is_behind_word = is_word(factor);
      row += power_of(factor, Around::factor);
    }
    return row;
  }

  /// Numerator or denominator, where a sum that is alone needs no brackets.
  [[nodiscard]] std::string part_of_fraction(const std::vector<Factor>& factors) const {
    return as_row(factors.size() == 1 ? power_of(factors.front(), Around::nothing) : row_of(1.0, factors));
  }

  [[nodiscard]] std::string power_of(const Factor& factor, Around around) const {
    if (factor.exponent == 1.0) return atom(factor.base, around);
    const std::string exponent = mathml_of_number(factor.exponent);
    const std::string_view function = is_named(factor.base) ? "" : name_of_function(steps_[factor.base].operation);
    if (!function.empty() && factor.exponent == std::round(factor.exponent))
      return fmt::format("<msup><mi>{}</mi>{}</msup>{}{}", function, exponent, of, arguments_of(factor.base));
    return fmt::format("<msup>{}{}</msup>", as_row(atom(factor.base, Around::base_of_power)), exponent);
  }

  /// A step as one factor.
  [[nodiscard]] std::string atom(Place place, Around around) const {
    if (is_named(place)) return names_[place];
    const Schedule::Step& step = steps_[place];
    switch (step.operation) {
      case Operation::input:
        return inputs_[step.input_index];
      case Operation::constant: {
        const bool is_simple = step.value >= 0.0 && around != Around::base_of_power;
        return is_simple ? mathml_of_number(step.value) : in_brackets(mathml_of_number(step.value));
      }
      case Operation::square_root: {
        const std::string root = fmt::format("<msqrt>{}</msqrt>", as_row(joined(sum(step.left))));
        return around == Around::base_of_power ? in_brackets(root) : root;
      }
      default:
        break;
    }
    if (const std::string_view function = name_of_function(step.operation); !function.empty()) {
      const std::string applied = fmt::format("<mi>{}</mi>{}{}", function, of, arguments_of(place));
      return around == Around::base_of_power ? in_brackets(applied) : applied;
    }
    const std::string content = joined(sum(place));
    return around == Around::nothing ? content : in_brackets(content);
  }

  /// The argument of a function: a name unchanged, all else in brackets.
  [[nodiscard]] std::string arguments_of(Place place) const {
    const Schedule::Step& step = steps_[place];
    if (step.operation == Operation::arc_tangent2)
      return as_row(in_brackets(joined(sum(step.left)) + "<mo>,</mo>" + joined(sum(step.right))));
    if (is_named(step.left)) return names_[step.left];
    if (steps_[step.left].operation == Operation::input) return inputs_[steps_[step.left].input_index];
    return as_row(in_brackets(joined(sum(step.left))));
  }

  const std::vector<Schedule::Step>& steps_;
  const std::vector<std::string>& inputs_;
  std::size_t parameters_;
  std::vector<std::string> names_;  // of the steps that have one
  std::vector<std::size_t> orders_;
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
