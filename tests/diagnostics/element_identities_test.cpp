#include "methods/diagnostics/element_identities.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/elements/galerkin_element.hpp"
#include "methods/transcription/elements/shooting_element.hpp"

namespace dmocbench {
namespace {

std::string in_words(const std::vector<std::string>& sentences) {
  return fmt::format("{}", fmt::join(sentences, "\n"));
}

/// The order of a method: that of the tableau, or of its explicit integrator or its control space if this is smaller.
int order_of(const std::string& method, const Tableau& tableau) {
  if (family_of(method).suffix == MethodSuffix::spaces) {
    const auto element = make_element(method);
    return std::min({tableau.order, element->rates(tableau).order, element->controls(tableau).order});
  }
  for (const std::string& integrator : explicit_integrator_names()) {
    if (method.find("_" + integrator + "_") == std::string::npos) continue;
    return std::min(tableau.order, explicit_integrator(integrator).order);
  }
  return tableau.order;
}

class IdentitiesOf : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(IdentitiesOf, HoldWithEveryTableau) {
  const auto& [method, family] = GetParam();
  const auto element = make_element(method);
  for (const int stages : tableau_stages(family)) {
    const Tableau tableau = make_tableau(family, stages);
    EXPECT_EQ(in_words(broken_identities(*element, tableau, order_of(method, tableau))), "") << "s = " << stages;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, IdentitiesOf,
                         testing::Combine(testing::ValuesIn(all_methods()), testing::ValuesIn(tableau_names())),
                         [](const auto& instance) {
                           return std::get<0>(instance.param) + "_" + std::get<1>(instance.param);
                         });

TEST(Identities, HoldOfGalerkinElementsWithEveryDegreeQuadratureAndControlSpace) {
  for (const int degree : {1, 2, 3}) {
    for (const char* family : {"gauss", "lobatto"}) {
      for (const int points : tableau_stages(family)) {
        for (int nodes = 1; nodes <= points && degree <= points; ++nodes) {
          for (const bool is_continuous : {false, true}) {
            if (nodes == 1 && is_continuous) continue;
            const std::string method = galerkin_name(degree, nodes, is_continuous);
            const Tableau tableau = make_tableau(family, points);
            EXPECT_EQ(in_words(broken_identities(*make_element(method), tableau, order_of(method, tableau))), "")
                << method << " " << family << " " << points;
          }
        }
      }
    }
  }
}

TEST(Identities, DoNotHoldOfAnElementWhoseOrderIsOverstated) {
  const std::string words = in_words(broken_identities(*make_element("dmoc"), gauss_tableau(2), 5));
  EXPECT_TRUE(words.starts_with("consistency: the error of one step of length h decreases as h^5.0")) << words;
}

/// An element of the library whose formulas are changed afterwards.
class Spoilt final : public Element {
 public:
  using Change = std::function<void(IntervalTrace&, const IntervalUnknowns&)>;
  Spoilt(const std::string& method, Change change)
      : Element("spoilt", "does not satisfy an identity", make_element(method)->node_state()),
        sound_(make_element(method)),
        change_(std::move(change)) {}

  [[nodiscard]] bool has_stage_unknowns() const override { return sound_->has_stage_unknowns(); }
  [[nodiscard]] IntervalTrace trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const override {
    IntervalTrace trace = sound_->trace(problem, tableau, unknowns);
    change_(trace, unknowns);
    return trace;
  }

 private:
  std::unique_ptr<Element> sound_;
  Change change_;
};

class SpoiltElement : public testing::TestWithParam<std::string> {
 protected:
  /// The only sentence about the element begins so.
  static void expect_only(const std::string& beginning, Spoilt::Change change) {
    const Tableau tableau = gauss_tableau(2);
    const auto sentences =
        broken_identities(Spoilt(GetParam(), std::move(change)), tableau, order_of(GetParam(), tableau));
    EXPECT_EQ(sentences.size(), 1U);
    EXPECT_TRUE(in_words(sentences).starts_with(beginning)) << in_words(sentences);
  }
};

TEST_P(SpoiltElement, IsToldOfAMissingEquation) {
  expect_only("counts: ", [](IntervalTrace& trace, const IntervalUnknowns&) {
    trace.stage_equations.conservativeResize(trace.stage_equations.size() - 1);
  });
}

TEST_P(SpoiltElement, IsToldOfAStageAtAnotherTime) {
  expect_only("counts: stage 2",
              [](IntervalTrace& trace, const IntervalUnknowns& unknowns) { trace.stages[1].t += 0.1 * unknowns.h; });
}

TEST_P(SpoiltElement, IsToldOfEquationsWithoutASolution) {
  expect_only("consistency: the equations of an interval cannot be solved",
              [](IntervalTrace& trace, const IntervalUnknowns&) { trace.stage_equations[1] = Expression(1.0); });
}

TEST_P(SpoiltElement, IsToldOfAnEquationOfLowerOrder) {
  expect_only("consistency: ", [](IntervalTrace& trace, const IntervalUnknowns& unknowns) {
    trace.stage_equations[0] += 0.01 * unknowns.h;
  });
}

TEST_P(SpoiltElement, IsToldOfACostOfLowerOrder) {
  expect_only("consistency: the error of one step of length h decreases as h^2.0",
              [](IntervalTrace& trace, const IntervalUnknowns& unknowns) { trace.cost += unknowns.h * unknowns.h; });
}

TEST_P(SpoiltElement, IsToldOfAnotherMomentumAtTheRightNode) {
  expect_only("momenta: right_momentum ", [](IntervalTrace& trace, const IntervalUnknowns& unknowns) {
    // Zero on the exact motion to the order of every method, but not as a formula.
    trace.right_momentum[0] += 0.001 * pow(unknowns.h, 6.0);
  });
}

TEST_P(SpoiltElement, IsToldOfDerivativesThatAreNotThoseOfItsValues) {
  expect_only("costates: ", [](IntervalTrace& trace, const IntervalUnknowns& unknowns) {
    trace.cost += 1e-12 * sin(1e12 * unknowns.left_q[0]);
  });
}

INSTANTIATE_TEST_SUITE_P(EveryKindOfNode, SpoiltElement,
                         testing::Values("dmoc", "hamiltonian", "tangent", "multiple_shooting_rk4_1", "galerkin_2_2"),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace dmocbench
