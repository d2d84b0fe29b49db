#include "methods/transcription/program_floors.hpp"

#include <algorithm>
#include <limits>

namespace dmocbench {

namespace {

/// The floor of every place, with `of_interval` for an interval.
Eigen::VectorXd floors_at(const Places& places, const Eigen::VectorXd& of_interval, double of_border) {
  Eigen::VectorXd floors(static_cast<Eigen::Index>(places.size()));
  const Eigen::Index last = of_interval.size() - 1;
  Eigen::Index i = 0;
  places.for_each([&](const Place& place) {
    const auto k = static_cast<Eigen::Index>(place.index);
    double floor = of_border;
    if (place.kind == Place::Kind::interval) floor = of_interval[k];
    if (place.kind == Place::Kind::node) {
      floor = std::max(of_interval[std::max<Eigen::Index>(k - 1, 0)], of_interval[std::min(k, last)]);
    }
    floors[i++] = floor;
  });
  return floors;
}

}  // namespace

RoundingFloors rounding_floors_of(const GuessMagnitudes& survey, const Eigen::VectorXd& steps,
                                  const IntervalStructure& structure) {
  constexpr double safety = 20.0;
  const double of_entries = safety * std::numeric_limits<double>::epsilon() * survey.largest_mass;
  const double terms = of_entries * survey.largest_configuration;
  // λ is multiplied by L_vv/h, which does not vanish with q; where L_vv depends on q, it grows with it.
  const double products = std::max(of_entries, terms);
  RoundingFloors floors{
      .smallest = terms / steps.maxCoeff(), .largest = products / steps.minCoeff(), .constraints = {}, .variables = {}};
  if (floors.smallest == floors.largest) return floors;
  floors.constraints = floors_at(structure.rows, terms * steps.cwiseInverse(), floors.smallest);
  floors.variables = floors_at(structure.unknowns, products * steps.cwiseInverse(), floors.largest);
  return floors;
}

}  // namespace dmocbench
