#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "methods/transcription/elements/element.hpp"

namespace dmocbench {

/// What follows the name of a family in the names of its methods.
enum class MethodSuffix : std::uint8_t {
  none,         ///< nothing: the family is a method
  integration,  ///< _INTEGRATOR_SUBSTEPS, such as "multiple_shooting_rk4_1"
  spaces,       ///< _DEGREE_NODES, such as "galerkin_2_1"; "_shared" if controls are continuous
};

/// A family of methods: elements that differ only in their tableau, and in what the suffix names.
///
/// A method is the argument of `make_element` and the entry of the column `method` in tables: the name of its family
/// and the suffix.
struct Family {
  std::string_view name;   ///< as on the command line
  std::string_view label;  ///< as figures call it
  int style = 0;           ///< its line style in figures, one of those in plots/style.gp
  /// The element; `suffix` is "", or the suffix without its first letter. Throws `Error` that names the missing part.
  std::unique_ptr<Element> (*make)(std::string_view suffix) = nullptr;
  bool is_of_paper = false;                  ///< one of those that the paper compares
  MethodSuffix suffix = MethodSuffix::none;  ///< in the names of methods
  bool is_condensed = false;                 ///< solvers see the program without its nodes (`SingleShooting`)
};

/// Every family, in the order of tables and legends: an element becomes a family by its row there.
[[nodiscard]] std::span<const Family> registered_families();

/// The family of a method. Throws `Error` that lists all methods if there is none.
[[nodiscard]] const Family& family_of(std::string_view method);

/// Names of the families that the paper compares: DMOC, Hamiltonian and tangent-space collocation. They are the
/// default of experiments, and each is a method. Statements about the paper's methods mean these.
[[nodiscard]] std::vector<std::string> paper_families();

/// Names of all families. A family with a suffix is not a method without one.
[[nodiscard]] std::vector<std::string> all_families();

/// Methods of all families; of shooting, one by each integrator with one step per interval; of galerkin, the one with
/// the lowest degrees.
[[nodiscard]] std::vector<std::string> all_methods();

}  // namespace dmocbench
