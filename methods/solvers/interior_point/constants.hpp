#pragma once

/// The constants of the interior-point method: of one solve (interior_point_solver.cpp) and of eight side by side
/// (../batch).
namespace dmocbench::interior_point::constants {

// Those of Wächter and Biegler, by their names there.
inline constexpr double mu_0 = 0.1;
inline constexpr double kappa_1 = 1e-2;
inline constexpr double kappa_epsilon = 10.0;
inline constexpr double kappa_mu = 0.2;
inline constexpr double theta_mu = 1.5;
inline constexpr double tau_min = 0.99;
inline constexpr double eta_phi = 1e-8;
inline constexpr double delta = 1.0;
inline constexpr double s_theta = 1.1;
inline constexpr double s_phi = 2.3;
inline constexpr double gamma_alpha = 0.05;
inline constexpr double kappa_soc = 0.99;
inline constexpr double kappa_resto = 0.9;
inline constexpr int p_max = 4;
inline constexpr double theta_min_ratio = 1e-4;
inline constexpr double theta_max_ratio = 1e4;

// Ours.
inline constexpr double of_warm_start = 1e-6;    ///< μ, and the push away from bounds
inline constexpr double largest_estimate = 1e3;  ///< of a least-squares multiplier
inline constexpr double short_step = 0.1;        ///< one after which multipliers are looked at
inline constexpr double runaway = 1e6;           ///< a multiplier that such a step has led to
inline constexpr double most_growth = 10.0;      ///< of the violation in one step
inline constexpr double shortest_step = 1e-14;
// Of steps towards feasibility alone.
inline constexpr double shortest_feasibility_step = 1e-10;
inline constexpr double sufficient_decrease = 1e-4;  ///< of the violation, as a share of what a whole step takes away
inline constexpr double very_short_step = 1e-3;
inline constexpr int most_jammed = 20;  ///< very short ones in a row

}  // namespace dmocbench::interior_point::constants
