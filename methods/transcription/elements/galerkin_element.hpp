#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "methods/transcription/elements/element.hpp"

namespace dmocbench {

/// A Galerkin variational integrator with a control space of its own (section 2.2 of the paper; Campos, Ober-Blöbaum,
/// Trélat 2015).
///
/// On an interval q is a polynomial of degree s and u one of degree m - 1; the tableau (b, c) is nothing but a
/// quadrature, with r >= s and r >= m points. Node: q_k. The interior unknowns are the rates Q̇_1 .. Q̇_{s-1} of q at
/// Gauss points d_1 .. d_s with the weights w_j, of which the last is eliminated; any other basis has the same
/// solutions. With ℓ_j the Lagrange polynomials of d_j and ℓ̂_l of the control nodes, the path at the quadrature points
/// is
///   Q_i = q_k + h Σ_j (∫₀^{c_i} ℓ_j) Q̇_j,   V_i = Σ_j ℓ_j(c_i) Q̇_j,   u_i = Σ_l ℓ̂_l(c_i) U_l.
/// With A = h Σ b_i L(Q_i, V_i) and W[δ] = h Σ b_i f(Q_i, V_i, u_i)·δQ_i the equations are `DmocElement`'s; the
/// interval's own are (∂A/∂Q̇_j + W[∂/∂Q̇_j]) / (h w_j) = 0, j = 1 .. s-1.
///
/// Control nodes are m Gauss points, each interval with controls of its own; m = 1 is a control that is constant on
/// every interval. Continuous controls have m >= 2 Lobatto nodes, the outer ones shared with the neighbours.
///
/// Started on an exact motion with its controls at the control nodes, the order is the smallest of 2s, 2r (Gauss
/// quadrature) or 2r - 2 (Lobatto), and 2m (Gauss nodes) or 2m - 2 (Lobatto nodes). By Gauss with r = s = m this is
/// `DmocElement`.
class GalerkinElement final : public Element {
 public:
  /// Degree s of q, number m of control nodes. Throws `Error` if one is not offered.
  GalerkinElement(int degree, int control_nodes, bool has_continuous_controls);

  /// Gauss with s stages. Throws `Error` if the quadrature has fewer points.
  [[nodiscard]] Tableau rates(const Tableau& quadrature) const override;
  /// Gauss, or Lobatto with shared controls, with m stages. Throws `Error` if the quadrature has fewer points.
  [[nodiscard]] Tableau controls(const Tableau& quadrature) const override;
  [[nodiscard]] IntervalTrace trace(const TracedProblem& problem, const Tableau& quadrature,
                                    const IntervalUnknowns& unknowns) const override;

 private:
  Tableau rates_;
  Tableau controls_;
};

/// The name of the family, as on the command line.
inline constexpr std::string_view galerkin_family = "galerkin";

/// "galerkin_2_1", "galerkin_2_2_shared": s, m, and whether controls are continuous.
[[nodiscard]] std::string galerkin_name(int degree, int control_nodes, bool has_continuous_controls);

/// The element of spaces S_M or S_M_shared, such as "2_1". Throws `Error` that names the missing part.
[[nodiscard]] std::unique_ptr<Element> make_galerkin_element(std::string_view spaces);

}  // namespace dmocbench
