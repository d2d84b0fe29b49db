#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Problems by their names, in the order in which they were added.
class Registry {
 public:
  /// Makes a problem.
  using Maker = std::function<std::unique_ptr<Problem>()>;

  /// What becomes of a problem that cannot be added.
  enum class Faults : std::uint8_t {
    thrown,  ///< `add` throws
    kept,    ///< it is among `refused`, and others can be added
  };
  /// A problem that could not be added.
  struct Refusal {
    std::string name;    ///< empty if its constructor throws
    std::string reason;  ///< a sentence that names its class
  };

  /// Without problems.
  explicit Registry(Faults faults = Faults::thrown) : faults_(faults) {}

  /// Adds the problem of a class, `registry.add<Furuta>()`; it is made by its default constructor. Throws `Error` if
  /// its name exists already, or is not suited to command lines and files: small letters, digits and underscores, a
  /// letter first, and not "all".
  template <class Type>
  void add() {
    add([]() -> std::unique_ptr<Problem> { return std::make_unique<Type>(); }, typeid(Type));
  }
  /// The same with an origin, in the place of an earlier problem with the same name and origin, if there is one.
  void put(Maker make, const std::string& origin);

  /// Adds all problems of another registry, which come from `origin`, such as the path of a library, except those whose
  /// names are there already: these are refused, as those that the other registry has refused.
  void add_all(const Registry& others, const std::string& origin);

  /// In the order in which they were added.
  [[nodiscard]] std::vector<std::string> names() const;
  /// The problem named `name` with its default parameters. Throws `Error` that lists the names if it is unknown, or as
  /// `check_problem`.
  [[nodiscard]] std::unique_ptr<Problem> make(std::string_view name) const;
  /// The same before `check_problem`, for callers that set parameters and then check it themselves.
  [[nodiscard]] std::unique_ptr<Problem> make_unchecked(std::string_view name) const;
  /// Those that could not be added, by `add_all` or with `Faults::kept`.
  [[nodiscard]] const std::vector<Refusal>& refused() const noexcept { return refused_; }
  /// The class of the problem named `name`, without its namespace. Throws as `make`.
  [[nodiscard]] const std::string& class_of(std::string_view name) const { return entry(name).type; }
  /// The origin of the problem named `name`; empty for problems that were added one by one. Throws as `make`.
  [[nodiscard]] const std::string& origin(std::string_view name) const;

 private:
  struct Entry {
    std::string name;
    Maker make;
    std::string origin;
    std::string type;  ///< its class
  };
  void add(Maker make, const std::type_info& type);
  [[nodiscard]] const Entry& entry(std::string_view name) const;
  /// Throws `Error` if a name exists already. `origin` is the origin of the problem to be added.
  void require_new(const std::string& name, const std::string& origin) const;

  Faults faults_;
  std::vector<Entry> entries_;
  std::vector<Refusal> refused_;
};

/// All known problems, which registry.hpp names and makes: the suite's own, and problems added to them. It must not be
/// changed while other threads read it.
[[nodiscard]] Registry& known_problems();

}  // namespace dmocbench
