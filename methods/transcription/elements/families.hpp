#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "methods/transcription/elements/element.hpp"

namespace dmocbench {

/// A family of methods: elements that differ only in their tableau, and in their integrator if they have one.
///
/// A method is the argument of `make_element` and the entry of the column `method` in tables. It has its family's name;
/// with an integrator NAME_INTEGRATOR_SUBSTEPS, such as "multiple_shooting_rk4_1".
struct Family {
  std::string_view name;   ///< as on the command line
  std::string_view label;  ///< as figures call it
  int style = 0;           ///< its line style in figures, one of those in plots/style.gp
  /// The element; `integration` is "" or, if the family takes an integrator, such as "rk4_1". Throws `Error` that
  /// names the missing part of `integration`.
  std::unique_ptr<Element> (*make)(std::string_view integration) = nullptr;
  bool is_of_paper = false;       ///< one of those that the paper compares
  bool takes_integrator = false;  ///< see above
  bool is_condensed = false;      ///< solvers see the program without its nodes (`SingleShooting`)
};

/// Every family, in the order of tables and legends: an element becomes a family by its row there.
[[nodiscard]] std::span<const Family> registered_families();

/// The family of a method. Throws `Error` that lists all methods if there is none.
[[nodiscard]] const Family& family_of(std::string_view method);

/// Names of the families that the paper compares: DMOC, Hamiltonian and tangent-space collocation. They are the
/// default of experiments, and each is a method. Statements about the paper's methods mean these.
[[nodiscard]] std::vector<std::string> paper_families();

/// Names of all families. Families that take an integrator are not methods without one.
[[nodiscard]] std::vector<std::string> all_families();

/// Methods of all families; of those that take an integrator, one by each with one step per interval.
[[nodiscard]] std::vector<std::string> all_methods();

}  // namespace dmocbench
