#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Problems by their names, in the order in which they were added.
class Registry {
 public:
  /// Makes a problem.
  using Maker = std::function<std::unique_ptr<Problem>()>;

  /// Adds the problem of a class, `registry.add<Furuta>()`; it is made by its default constructor. Throws `Error` if
  /// its name is there already, or is no name that a command line and a file take: small letters, digits and
  /// underscores, a letter first, and not "all".
  template <class Type>
  void add() {
    add([]() -> std::unique_ptr<Problem> { return std::make_unique<Type>(); });
  }
  /// Adds the problem that this makes.
  void add(Maker make);
  /// The same with an origin, in the place of an earlier problem of that name and origin, if there is one.
  void put(Maker make, const std::string& origin);

  /// Adds all problems of another registry, which come from `origin`, such as the path of a library. Throws `Error`,
  /// and adds none, if one of their names is there already.
  void add_all(const Registry& others, const std::string& origin);

  /// In the order in which they were added.
  [[nodiscard]] std::vector<std::string> names() const;
  /// The problem of that name with its default parameters. Throws `Error` that lists the names if there is none, or as
  /// `check_problem`.
  [[nodiscard]] std::unique_ptr<Problem> make(std::string_view name) const;
  /// The same before `check_problem`, for callers that set parameters and then check it themselves.
  [[nodiscard]] std::unique_ptr<Problem> make_unchecked(std::string_view name) const;
  /// Where the problem of that name comes from; empty for what was added one by one. Throws as `make`.
  [[nodiscard]] const std::string& origin(std::string_view name) const;

 private:
  struct Entry {
    std::string name;
    Maker make;
    std::string origin;
  };
  [[nodiscard]] const Entry& entry(std::string_view name) const;
  /// Throws `Error` if a name is there already. `origin` is that of the problem which would be added.
  void require_new(const std::string& name, const std::string& origin) const;

  std::vector<Entry> entries_;
};

/// All problems that this process knows, those that registry.hpp names and makes: the suite's own, and what has been
/// added to them. Not to be changed while other threads read it.
[[nodiscard]] Registry& known_problems();

}  // namespace dmocbench
