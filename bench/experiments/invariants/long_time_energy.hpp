#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/run/column.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// An integrator of the unforced Kepler ellipse that is followed for many periods.
struct LongTimeMethod {
  /// The rules of one step.
  enum class Kind : std::uint8_t { dmoc, radau, explicit_midpoint, runge_kutta_4 };
  Kind kind = Kind::dmoc;  ///< the rule of a step
  std::string name;        ///< of the kind
  std::string tableau;     ///< of the implicit ones; empty for the others
  int stages = 0;          ///< of a step
  int order = 0;           ///< of convergence
};

/// DMOC with one and two Gauss stages, explicit Runge-Kutta methods of the same orders, and Radau IIA of order 5: the
/// implicit collocation of the equations of motion that is neither symplectic nor symmetric.
[[nodiscard]] std::vector<LongTimeMethod> long_time_methods();

/// The error of the energy during one period, over its steps.
struct PeriodEnergy {
  long long period = 0;   ///< 0 is the first
  double smallest = 0.0;  ///< over the steps of the period
  double mean = 0.0;      ///< over the same
  double largest = 0.0;   ///< over the same
};

/// Energy minus the initial energy along the ellipse of `Kepler`, a row per watched period: every period if there are
/// fewer than 400, else the first ten and at least 200 others at even distances. Throws `Error` if a step cannot be
/// solved.
[[nodiscard]] std::vector<PeriodEnergy> long_time_energy(const LongTimeMethod& method, int steps_per_period,
                                                         long long periods);

/// Oscillation of the energy within a period, and drift of its mean over the periods.
struct EnergyBehaviour {
  double oscillation = 0.0;       ///< max - min over the watched periods among the first ten
  double range = 0.0;             ///< max - min over all watched periods: the oscillation again, unless energy drifts
  double drift_per_period = 0.0;  ///< of the mean over the periods, by least squares
  double standard_error = 0.0;    ///< of the drift
  double change = 0.0;            ///< last mean minus first mean
};

/// The behaviour over the watched periods. Throws `Error` if there are fewer than three.
[[nodiscard]] EnergyBehaviour energy_behaviour(const std::vector<PeriodEnergy>& periods);

/// The columns of the energy during one period, which is a member of a record.
template <class Record>
Columns<Record> period_energy_columns(PeriodEnergy Record::*energy) {
  return {{"period", "", "number of the period, from 0", from(energy, &PeriodEnergy::period), in_key},
          {"energy_smallest", "", "smallest error of the energy", from(energy, &PeriodEnergy::smallest)},
          {"energy_mean", "", "mean error of the energy over the period", from(energy, &PeriodEnergy::mean)},
          {"energy_largest", "", "largest error of the energy", from(energy, &PeriodEnergy::largest)}};
}

/// The columns of the energy over many periods, which is a member of a record.
template <class Record>
Columns<Record> energy_behaviour_columns(EnergyBehaviour Record::*energy) {
  return {{"oscillation", "", "error range over the first ten periods", from(energy, &EnergyBehaviour::oscillation)},
          {"range", "", "error range over all observed periods", from(energy, &EnergyBehaviour::range)},
          {"drift_per_period", "", "least-squares slope of the mean error",
           from(energy, &EnergyBehaviour::drift_per_period)},
          {"standard_error", "", "standard error of the drift", from(energy, &EnergyBehaviour::standard_error)},
          {"change", "", "last mean error minus first mean error", from(energy, &EnergyBehaviour::change)}};
}

}  // namespace dmocbench
