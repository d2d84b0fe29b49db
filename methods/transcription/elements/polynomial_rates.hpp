#pragma once

#include <Eigen/Core>

#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

// A motion of degree s on an interval, given by its rates at the s stages of a Gauss tableau. With ℓ_j their Lagrange
// polynomials: at the times c, relative to the interval, positions and accelerations as combinations of the rates.

/// Row i: ∫₀^{c_i} ℓ_j, by a quadrature of the stages' own, which is exact for ℓ_j.
[[nodiscard]] Eigen::MatrixXd integrals_to(const Eigen::VectorXd& c, const Tableau& stages);

/// Row i: ℓ_j'(c_i).
[[nodiscard]] Eigen::MatrixXd derivatives_at(const Eigen::VectorXd& c, const Tableau& stages);

}  // namespace dmocbench
