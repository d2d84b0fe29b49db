#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace dmocbench {

class Problem;
struct Parameter;

/// As long as it exists, `parameter` and `varying` of a problem have other values for this thread: everything read from
/// the problem (ends, bounds, guess, diagnostics) uses these values, while the problem itself is unchanged and
/// other threads may read it. The innermost scope of a problem counts, also a `ForwardingProblem` of it. Values are one
/// per parameter, in the order of `Problem::parameters`.
class ParameterScope {
 public:
  /// Throws `Error` if there is not one value per parameter, or a value is not allowed (`Parameter::check`).
  ParameterScope(const Problem& problem, Eigen::VectorXd values);
  virtual ~ParameterScope();
  ParameterScope(const ParameterScope&) = delete;
  ParameterScope& operator=(const ParameterScope&) = delete;

  /// The innermost scope of the problem in this thread; null if there is none.
  [[nodiscard]] static ParameterScope* of(const Problem& problem) noexcept;

  /// The value of a parameter by its place in `Problem::parameters`.
  [[nodiscard]] double value(std::size_t parameter) const { return values_[static_cast<Eigen::Index>(parameter)]; }

 protected:
  /// A formula reads a parameter by `varying`. Returns the number of the input that it is; none where it is a number.
  [[nodiscard]] virtual std::optional<std::size_t> read_varying(std::size_t parameter);
  /// Something reads a parameter as a number.
  virtual void read_as_number(std::size_t parameter);

 private:
  friend class Problem;
  friend class SharedParameters;

  const std::vector<Parameter>& parameters_;
  Eigen::VectorXd values_;
  ParameterScope* outer_;
};

/// As long as it exists, the parameters of a part of a problem are the whole's parameters of the same names: they have
/// their values, and are inputs where those are.
class SharedParameters final : public ParameterScope {
 public:
  /// Throws `Error` if the whole lacks a parameter of the part.
  SharedParameters(const Problem& whole, const Problem& part);

 private:
  [[nodiscard]] std::optional<std::size_t> read_varying(std::size_t parameter) override;
  void read_as_number(std::size_t parameter) override;

  ParameterScope* whole_;             // null outside of all scopes
  std::vector<std::size_t> numbers_;  // of the part's parameters among the whole's
};

/// As long as it exists, formulas that this thread traces of a problem have the parameters that are kept open as inputs
/// 0, 1, ... (`Problem::varying`), and it is noted which others they read.
class ParameterTrace final : public ParameterScope {
 public:
  /// `open`: names of the parameters that are kept open, in addition to the unknown ones. Throws `Error` if a name is
  /// unknown, one occurs twice, or its values are whole numbers.
  ParameterTrace(const Problem& problem, const std::vector<std::string>& open);

  /// The parameters that are kept open, the unknown ones last, by their numbers among all: input i's at i.
  [[nodiscard]] const std::vector<std::size_t>& open() const noexcept { return open_; }
  /// Throws `Error` if no formula has read one of the unknown parameters.
  void require_unknowns_read() const;
  /// Per parameter, whether a formula has read it as a number, or by `varying` though it is not kept open: its value is
  /// a constant of the trace now.
  [[nodiscard]] std::vector<bool> are_constants() const;
  /// Per parameter that is not an unknown, whether formulas have read it by `varying` and nowhere as a number.
  [[nodiscard]] std::vector<bool> are_varying() const;

 private:
  [[nodiscard]] std::optional<std::size_t> read_varying(std::size_t parameter) override;
  /// Throws `Error` if the parameter is kept open.
  void read_as_number(std::size_t parameter) override;

  const Problem& problem_;
  std::vector<std::size_t> open_;
  std::vector<bool> varies_;     // per parameter: read by `varying`
  std::vector<bool> is_number_;  // read as a number
};

/// A problem as solved: its unknown parameters have these values, moved into their ranges, in the order of
/// `Problem::unknowns`; all others keep those that this thread sees.
[[nodiscard]] ParameterScope with_unknowns(const Problem& problem, const Eigen::VectorXd& values);

/// The values of a problem's parameters as this thread sees them, in the order of `Problem::parameters`.
[[nodiscard]] Eigen::VectorXd parameter_values(const Problem& problem);
/// The number of a parameter among them. Throws `Error` if the name is unknown.
[[nodiscard]] std::size_t parameter_number(const Problem& problem, std::string_view name);

}  // namespace dmocbench
