#pragma once

/// The constants of the method, by their names in Wächter and Biegler (2006), with the equation, step or section that
/// they stand in there. γ_θ and γ_φ are the filter's (`Filter::margin`), the constants of Algorithm IC the shift's
/// (`InertiaShift`), s_max is the stop rule's (`StopRule::scale`).
namespace dmocbench::interior_point::constants {

// The start, section 3.6.
inline constexpr double mu_0 = 0.1;        // the first μ
inline constexpr double kappa_1 = 1e-2;    // how far a start is pushed away from its bounds
inline constexpr double lambda_max = 1e3;  // larger least-squares multipliers, (36), are not used
// The barrier parameter.
inline constexpr double kappa_epsilon = 10.0;  // a barrier problem is solved where E_μ <= κ_ε μ
inline constexpr double kappa_mu = 0.2;        // (7)
inline constexpr double theta_mu = 1.5;        // (7)
// The multipliers of bounds.
inline constexpr double kappa_sigma = 1e10;  // (16): how far z may be from μ over the distance, as a factor
// The line search.
inline constexpr double tau_min = 0.99;          // (8)
inline constexpr double delta = 1.0;             // (19)
inline constexpr double s_theta = 1.1;           // (19)
inline constexpr double s_phi = 2.3;             // (19)
inline constexpr double eta_phi = 1e-8;          // (20)
inline constexpr double theta_max_ratio = 1e4;   // (21): θ_max over max(1, θ) at the start
inline constexpr double theta_min_ratio = 1e-4;  // θ_min over the same
inline constexpr double gamma_alpha = 0.05;      // (23)
inline constexpr double kappa_soc = 0.99;
inline constexpr int p_max = 4;
// The restoration, section 3.3.
inline constexpr double kappa_resto = 0.9;  // the share of θ that it may leave
inline constexpr double largest_z = 1e3;    // larger multipliers of bounds become 1 after it
// Its steps towards feasibility alone; ours.
inline constexpr double shortest_feasibility_step = 1e-10;
inline constexpr double sufficient_decrease = 1e-4;  // of the violation, as a share of the decrease by a whole step
inline constexpr double very_short_step = 1e-3;
inline constexpr int most_blocked_steps = 20;  // very short ones in a row, where bounds leave no room

// Named after Ipopt's options: "Blocking filter". Ipopt waits for 5 searches.
inline constexpr int filter_reset_trigger = 10;
inline constexpr int max_filter_resets = 5;

// Ours, see README.md.
inline constexpr double of_warm_start = 1e-6;  // a warm start's μ, and in place of κ_1
inline constexpr double most_growth = 10.0;    // of the violation in one step: "Limit on the constraint violation"
inline constexpr double short_step = 0.1;      // "Short steps", "Divergence of the multipliers": up to this
inline constexpr double runaway = 1e6;         // multipliers above this are estimated again
inline constexpr int most_near = 10;           // iterates in a row that are accepted before the last one is: "Stopping"

}  // namespace dmocbench::interior_point::constants
