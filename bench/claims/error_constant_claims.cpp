// Errors to leading order: predicted from the exact optimum and measured, and what positions alone at the nodes are
// worth.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "bench/claims/claim.hpp"

namespace dmocbench {

namespace {

const Problems of_paper_and_examples{orbit, two_link, "examples"};
constexpr std::array tables_of_limits{"error_constants_limits", "error_constants_two_stages_limits"};

/// The limits of a problem of the paper, or of all other problems.
Selection limits_of(const ResultTables& tables, const char* table, const std::string& problem) {
  return tables.rows(table).where([&](const Row& row) {
    const bool is_of_paper = std::ranges::count(of_paper, row.text("problem")) > 0;
    return problem == "examples" ? !is_of_paper : row.text("problem") == problem;
  });
}

/// The limit of another quantity or method in the case of a row.
const Row& partner_of(const Row& row, const Selection& limits, const std::string& method, const std::string& quantity) {
  const Selection same = limits.matching(row, {"problem", "tableau", "stages", "solver", "derivatives"});
  const Selection partner = same.where("method", method).where("quantity", quantity);
  require(!partner.empty(), "error_constants_limits.csv has no limit of {} of {} by {}", quantity, row.text("problem"),
          method);
  return partner.front();
}

/// The quotient of the limits of one quantity by two methods.
Measurement ratio_of_limits(const char* name, const Row& row, const Selection& limits, const char* method,
                            const char* rival, const std::string& quantity) {
  return {name,
          partner_of(row, limits, method, quantity).needed("constant") /
              partner_of(row, limits, rival, quantity).needed("constant"),
          method, fmt::format("{}, s = {}", row.text("problem"), row.text("stages"))};
}

/// Whether measured limits are the predicted ones as far as both are known: each to its uncertainty.
Predicate limits_are_predicted(const std::string& quantity) {
  return [quantity](const ResultTables& tables, const std::string& problem) {
    const std::string prediction = "predicted_" + quantity;
    Selection limits = limits_of(tables, tables_of_limits[0], problem);
    limits.append(limits_of(tables, tables_of_limits[1], problem));
    const Selection measured = limits.where("quantity", quantity);
    require(!measured.empty(), "error_constants_limits.csv has no limits of {}", problem);
    const auto difference = [&](const Row& row) {
      return std::abs(row.needed("constant") -
                      partner_of(row, limits, row.text("method"), prediction).needed("constant"));
    };
    const double of_known = measured.max([&](const Row& row) {
      const Row& predicted = partner_of(row, limits, row.text("method"), prediction);
      return difference(row) / (row.needed("uncertainty") + predicted.needed("uncertainty"));
    });
    const double relative =
        measured.max([&](const Row& row) { return difference(row) / std::abs(row.needed("constant")); });
    Finding finding = found(of_known <= 1.0,
                            "{} predicted and measured limits have relative differences of at most {:.0e} and differ "
                            "by at most {:.2f} times the sum of their uncertainties",
                            measured.size(), Measurement{"largest relative difference of the limits", relative},
                            Measurement{"largest share of the uncertainties", of_known});
    for (const Row& row : measured.where("method", "dmoc")) {
      if (problem == "examples") break;
      const auto to_tangent = [&](const char* name, const std::string& of) {
        return ratio_of_limits(name, row, limits, "dmoc", "tangent", of);
      };
      finding = std::move(finding).also(worded(
          "ratio of the errors (DMOC to tangent-space collocation), s = {}: predicted {:.4f}, measured {:.4f}",
          row.text("stages"), to_tangent("predicted ratio", prediction), to_tangent("measured ratio", quantity)));
    }
    return finding;
  };
}

/// Limits of replay errors of second-order collocation over DMOC's, a sentence for each direction.
Finding second_order_replay(const ResultTables& tables, const std::string& /*problem*/) {
  const Selection limits = tables.rows(tables_of_limits[0]);
  const Selection rows = limits.where("method", "second_order").where("quantity", "replay_error");
  require(!rows.empty(), "error_constants_limits.csv has no limit of second_order");
  const auto ratios = [&](const Selection& some, const char* name, const char* quantity) {
    return joined(some, ", ", [&](const Row& row) {
      return worded("{} {:.2f}", row.text("problem"),
                    ratio_of_limits(name, row, limits, "second_order", "dmoc", quantity));
    });
  };
  const auto sentence = [&](const char* direction, bool is_larger) {
    const Selection some = rows.where([&](const Row& row) {
      return (row.needed("constant") > partner_of(row, limits, "dmoc", "replay_error").needed("constant")) == is_larger;
    });
    if (some.empty()) return Words();
    return worded(
        "its controls miss the final state by {} than DMOC's (ratios of the limits: {}; ratios of the largest "
        "errors of q at the nodes: {})",
        direction, ratios(some, "ratio of replay errors", "replay_error"),
        ratios(some, "ratio of errors of q", "state_error"));
  };
  return Finding{.clauses = {}, .verdict = ClaimVerdict::measured}
      .also(sentence("more", true))
      .also(sentence("less", false));
}

}  // namespace

/// Claims about limits of errors.
Claims error_constant_claims() {
  const auto predicted = [](const char* id, const char* quantity, const char* states) {
    return Claim{.id = id,
                 .problems = of_paper_and_examples,
                 .where = "section 3.6",
                 .states = states,
                 .judge = limits_are_predicted(quantity),
                 .condition =
                     "with one and two Gauss stages; no bound is active. The uncertainty of a limit is its change when "
                     "the finest grid is left out plus, for replays, the tolerance of the replay. A single limit "
                     "further from its prediction than the sum of both uncertainties would refute the statement",
                 .evidence = {"error_constants_limits.csv", "error_constants_two_stages_limits.csv",
                              "figures/two_link_manipulator_error_constants.svg"}};
  };
  return {
      predicted("replay_error_is_predicted", "replay_error",
                "to leading order, the error of the replay is the global error of the discrete flow with the exact "
                "optimal controls: errors of the optimum do not enter"),
      predicted("cost_error_is_predicted", "objective_error",
                "to leading order, the error of the cost is the sum of the defects of the exact optimum in the "
                "discrete flow, each times the costate, and of the errors of the quadrature"),
      {.id = "second_order_replay",
       .problems = examples,
       .where = "section 3.3, Implementation",
       .states =
           "replay errors of second-order collocation compared with DMOC's in the limit of fine grids: like DMOC, it "
           "has only positions at its nodes",
       .judge = second_order_replay,
       .condition = "with one Gauss stage, controls are constant over an interval; the limits belong to the flows "
                    "with the exact controls (`replay_error_is_predicted`)",
       .evidence = {"error_constants_limits.csv", "figures/two_link_manipulator_error_constants.svg"},
       .has_verdict = false}};
}

}  // namespace dmocbench
