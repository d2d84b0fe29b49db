#pragma once

#include "bench/experiments/invariants/long_time_energy.hpp"
#include "bench/run/column.hpp"

namespace dmocbench {

/// The columns of the energy during one period, which is a member of a record.
template <class Record>
Columns<Record> period_energy_columns(PeriodEnergy Record::*energy) {
  return {{"period", "", "number of the period, from 0", from(energy, &PeriodEnergy::period), in_key},
          {"energy_smallest", "", "smallest error of the energy", from(energy, &PeriodEnergy::smallest)},
          {"energy_mean", "", "mean error over the period", from(energy, &PeriodEnergy::mean)},
          {"energy_largest", "", "largest error of the energy", from(energy, &PeriodEnergy::largest)}};
}

/// The columns of the energy over many periods, which is a member of a record.
template <class Record>
Columns<Record> energy_behaviour_columns(EnergyBehaviour Record::*energy) {
  return {{"oscillation", "", "max - min over the first ten periods", from(energy, &EnergyBehaviour::oscillation)},
          {"range", "", "max - min over all watched periods", from(energy, &EnergyBehaviour::range)},
          {"drift_per_period", "", "of the mean, by least squares", from(energy, &EnergyBehaviour::drift_per_period)},
          {"standard_error", "", "of the drift", from(energy, &EnergyBehaviour::standard_error)},
          {"change", "", "last mean minus first mean", from(energy, &EnergyBehaviour::change)}};
}

}  // namespace dmocbench
