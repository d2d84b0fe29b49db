#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "methods/expression/vectors.hpp"

namespace dmocbench {

/// A name as MathML shows it: "theta_1" as θ with the index 1, longer words upright.
[[nodiscard]] std::string mathml_of_name(std::string_view name);
/// The rate of a quantity with that name: with a dot.
[[nodiscard]] std::string mathml_of_rate(std::string_view name);
/// A number: as a whole number, as a fraction or as a multiple of π where it is one to the last digit but one, or else
/// with all its digits.
[[nodiscard]] std::string mathml_of_number(double value);

/// A formula as MathML, term by term, so that lines may be broken between them. A term but the first begins with its
/// sign.
using MathTerms = std::vector<std::string>;

/// Formulas in usual notation, in presentation MathML: fractions, powers, products without a sign.
struct TypesetFormulas {
  /// The formulas in the order in which they were given.
  std::vector<MathTerms> formulas;
  /// Long parts that several places share: name and formula. Later ones may contain earlier ones.
  std::vector<std::pair<std::string, MathTerms>> shared;
};

/// The operations of the longest formula that is typeset.
inline constexpr std::size_t most_typeset_operations = 1000;

/// Typesets traced formulas. `inputs` are the names of their inputs as MathML; the first `parameters` of them are
/// constants, which stand before other factors. `shared_name` is the name of shared parts, which get an index: not the
/// name of an input.
///
/// A formula of more than `most_typeset_operations` is not typeset but shown as "a formula of 10000 operations": it
/// would be unreadable, and typesetting recurses.
///
/// Sums and products are written without the brackets that do not change their value; apart from rounding, the
/// written form has the value of the formula wherever that is defined.
[[nodiscard]] TypesetFormulas typeset(std::span<const Expression> formulas, const std::vector<std::string>& inputs,
                                      std::size_t parameters, std::string_view shared_name);

}  // namespace dmocbench
