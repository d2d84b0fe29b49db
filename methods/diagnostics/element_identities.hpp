#pragma once

#include <string>
#include <vector>

#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

/// A sentence for each of the four identities of `Element` that an element does not satisfy with a tableau; none if it
/// satisfies all. A test of an own element needs no more than this:
///
///   EXPECT_EQ(broken_identities(MyElement(), gauss_tableau(2), 4), std::vector<std::string>());
///
/// `order` is the order of the element's one-step map: `tableau.order` of collocation, the smaller one of this and the
/// order of the integrator of shooting. A higher order than this is not a violation.
///
/// The system has two degrees of freedom, a mass matrix that depends on q, a momentum that depends on q and t, damping
/// and two controls, and a motion with known controls. The element is traced on it; counts are compared first, because
/// without them nothing can be solved. Orders are measured with steps from 0.4 to 0.0125, in long double, until the
/// errors are rounding; momenta are compared at arbitrary points; costates with central differences of the cost to go
/// through the solved interval.
[[nodiscard]] std::vector<std::string> broken_identities(const Element& element, const Tableau& tableau, int order);

}  // namespace dmocbench
