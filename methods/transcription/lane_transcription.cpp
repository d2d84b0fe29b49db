#include "methods/transcription/lane_transcription.hpp"

#include <array>
#include <utility>
#include <vector>

#include "methods/error.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/transcription/derivatives/part_places.hpp"
#include "methods/transcription/derivatives/program_part.hpp"

namespace dmocbench {

namespace {

Eigen::VectorXd each_for_all_lanes(const Eigen::VectorXd& values) {
  return values.transpose().replicate(instance_lanes, 1).reshaped();
}

Eigen::Map<Eigen::VectorXd> map(double* first, Eigen::Index size) {
  return {first, size * static_cast<Eigen::Index>(instance_lanes)};
}
Eigen::Map<const Eigen::VectorXd> map(const double* first, Eigen::Index size) {
  return {first, size * static_cast<Eigen::Index>(instance_lanes)};
}

std::vector<SeriesPlace> interleaved(std::vector<SeriesPlace> places) {
  for (SeriesPlace& place : places) place.first *= instance_lanes;
  return places;
}

/// Where the local entries of interval 0 stand in the program's matrix.
std::vector<SeriesPlace> places_in(const BlockPattern& pattern, const LocalEntries& entries) {
  std::vector<SeriesPlace> places;
  for (std::size_t e = 0; e < entries.rows.size(); ++e) {
    const auto found = pattern.find(entries.rows[e].first, entries.columns[e].first);
    if (!found) throw Error("an entry of an interval is not in the program's matrix");
    places.emplace_back(*found);
  }
  return places;
}

/// The places of a part in interleaved vectors: eight times as many intervals, all else eight times as far apart.
PartPlaces interleaved_places(const Transcription& program, const LocalFunctions& functions,
                              const std::vector<SeriesPlace>& unknowns, const std::vector<SeriesPlace>& rows,
                              bool has_ends_only) {
  const std::size_t intervals = has_ends_only ? 1 : program.blocks().intervals();
  const BlockPattern& jacobian = program.jacobian_structure();
  const BlockPattern& hessian = program.hessian_structure();
  return part_places(functions, interleaved(unknowns), interleaved(rows),
                     interleaved(places_in(jacobian, jacobian_entries(functions, rows, unknowns, intervals))),
                     interleaved(places_in(hessian, hessian_entries(functions, unknowns, intervals))),
                     {.variables = program.variable_count() * instance_lanes,
                      .constraints = program.constraint_count() * instance_lanes,
                      .jacobian = jacobian.size() * instance_lanes,
                      .hessian = hessian.size() * instance_lanes},
                     intervals * instance_lanes, has_ends_only ? AssemblyMode::part : AssemblyMode::whole);
}

}  // namespace

/// The functions of all intervals, or of the ends, on interleaved vectors.
struct LaneTranscription::Part {
  Part(const LaneTranscription& lanes, const LocalFunctions& functions, PartPlaces places)
      : parameters(static_cast<Eigen::Index>(places.constraints.intervals * functions.inputs.parameters)),
        values(functions, std::move(places), lanes.steps_, lanes.times_, parameters, "tape") {}

  Eigen::VectorXd parameters;  // per open parameter: one value per interval and lane
  ProgramPart values;
};

LaneTranscription::LaneTranscription(const Transcription& program)
    : program_(program),
      usual_parameters_(program.parameter_values()),
      variables_(static_cast<Eigen::Index>(program.variable_count())),
      rows_(static_cast<Eigen::Index>(program.constraint_count())),
      jacobian_entries_(static_cast<Eigen::Index>(program.jacobian_structure().size())),
      hessian_entries_(static_cast<Eigen::Index>(program.hessian_structure().size())),
      steps_(each_for_all_lanes(program.step_inputs())),
      times_(each_for_all_lanes(program.time_inputs())) {
  program.traced_problem().require_no_constraints("a batch");
  if (program.traced_problem().first_order_size() > 0 || program.traced_problem().integral_count() > 0) {
    throw Error("a batch supports neither first-order states nor integral constraints");
  }
  if (program.traced_problem().unknown_count() > 0) throw Error("a batch does not support unknown parameters");
  if (!program.bounds().interior.empty()) throw Error("a batch does not support bounds between the ends");
  if (program.has_free_horizon()) throw Error("a batch does not support a free horizon");
  const ProgramBlocks& blocks = program.blocks();
  const auto add = [&](const LocalFunctions& functions, const std::vector<SeriesPlace>& unknowns,
                       const std::vector<SeriesPlace>& rows, bool has_ends_only) {
    parts_.push_back(std::make_unique<Part>(*this, functions,
                                            interleaved_places(program, functions, unknowns, rows, has_ends_only)));
  };
  add(program.functions(), blocks.unknown_places(), blocks.row_places(), false);
  if (const auto& ends = program.end_functions()) {
    add(*ends, blocks.end_unknown_places(), blocks.end_row_places(), true);
  }
  if (parameter_count() == 0) return;
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) set_parameters(lane, {});
}

std::size_t LaneTranscription::parameter_count() const {
  return program_.traced_problem().open_parameters().empty() ? 0 : static_cast<std::size_t>(usual_parameters_.size());
}

void LaneTranscription::set_parameters(std::size_t lane, std::span<const double> values) {
  const std::vector<std::size_t>& open = program_.traced_problem().open_parameters();
  if (open.empty()) return;
  const Eigen::VectorXd all =
      values.empty() ? usual_parameters_
                     : Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  const double horizon = checked_horizon(all);
  const auto lanes = static_cast<Eigen::Index>(instance_lanes);
  const auto at = static_cast<Eigen::Index>(lane);
  for (std::size_t i = 0; i < open.size(); ++i) {
    for (const auto& part : parts_) {
      const Eigen::Index count = part->parameters.size() / static_cast<Eigen::Index>(open.size());
      part->parameters(Eigen::seqN(static_cast<Eigen::Index>(i) * count + at, count / lanes, lanes))
          .setConstant(all[static_cast<Eigen::Index>(open[i])]);
    }
  }
  const auto of_lane = Eigen::seqN(at, program_.grid().relative_widths().size(), lanes);
  steps_(of_lane) = horizon * program_.grid().relative_widths();
  times_(Eigen::seqN(at, program_.grid().relative_times().size(), lanes)) = horizon * program_.grid().relative_times();
}

/// The horizon of the problem with these parameters, whose bounds must equal the program's.
double LaneTranscription::checked_horizon(const Eigen::VectorXd& parameters) const {
  const Problem& problem = program_.problem();
  for (Eigen::Index i = 0; i < parameters.size(); ++i) {
    if (parameters[i] == usual_parameters_[i] ||
        !program_.traced_problem().are_constants()[static_cast<std::size_t>(i)]) {
      continue;
    }
    throw Error("the formulas contain the parameter " + problem.parameters()[static_cast<std::size_t>(i)].name +
                "; to change it, keep it open when the transcription is created");
  }
  const auto bounds_with = [&](const Eigen::VectorXd& values) {
    const ParameterScope scope(problem, values);
    return std::pair(problem.bounds(), problem.horizon());
  };
  const auto [usual, usual_horizon] = bounds_with(usual_parameters_);
  const auto [now, horizon] = bounds_with(parameters);
  // Where there are none they may be empty.
  const auto are_same = [](const Bounds& a, const Bounds& b) {
    return a.lower.size() == b.lower.size() && a.lower == b.lower && a.upper == b.upper;
  };
  if (!are_same(usual.q, now.q) || !are_same(usual.v, now.v) || !are_same(usual.u, now.u) ||
      !are_same(usual.path, now.path) || !are_same(usual.integrals, now.integrals)) {
    throw Error("the parameters of an instance change bounds, but all instances of a batch have the same bounds");
  }
  return horizon;
}

LaneTranscription::~LaneTranscription() = default;

void LaneTranscription::objective(const double* x, double* result) {
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) result[lane] = 0.0;
  for (const auto& part : parts_) {
    const Eigen::VectorXd& costs = part->values.costs(map(x, variables_));
    std::array<double, instance_lanes> sums{};
    lane_loops().sum(costs.data(), costs.size() / static_cast<Eigen::Index>(instance_lanes), sums.data());
    for (std::size_t lane = 0; lane < instance_lanes; ++lane) result[lane] += sums[lane];
  }
}

void LaneTranscription::gradient(const double* x, double* result) {
  for (const auto& part : parts_) part->values.gradient(map(x, variables_), map(result, variables_));
}

void LaneTranscription::constraints(const double* x, double* result) {
  for (const auto& part : parts_) part->values.rows(map(x, variables_), map(result, rows_));
}

void LaneTranscription::jacobian(const double* x, double* values) {
  for (const auto& part : parts_) part->values.jacobian(map(x, variables_), map(values, jacobian_entries_));
}

void LaneTranscription::hessian(const double* x, const double* multipliers, double* values) {
  for (const auto& part : parts_) {
    part->values.hessian(map(x, variables_), 1.0, map(multipliers, rows_), map(values, hessian_entries_));
  }
}

MakeLanes lanes_of(const Transcription& program) {
  return [&program] { return std::make_unique<LaneTranscription>(program); };
}

std::function<void(const Eigen::VectorXd&)> parameters_of(Transcription& program) {
  return [&program, usual = Eigen::VectorXd(program.parameter_values())](const Eigen::VectorXd& values) {
    program.set_parameters(values.size() > 0 ? values : usual);
  };
}

ClampedEnds::ClampedEnds(const Transcription& program) : program_(program), legendre_(program.traced_problem()) {
  const bool are_clamped = program.bounds().first.all_fixed() && program.bounds().last.all_fixed();
  if (!are_clamped || program.has_free_horizon()) {
    throw Error("the end states of this problem are not fixed, so instances of a batch cannot differ in them");
  }
}

void ClampedEnds::write(const BoundaryState& first, const BoundaryState& last, Eigen::VectorXd& x,
                        Eigen::VectorXd& equality_values) {
  const Eigen::VectorXd& times = program_.grid().relative_times();
  for (Eigen::Index i = 0; i < first.q.size(); ++i) {
    auto nodes = x.segment(program_.blocks().unknown(Quantity::configuration).index(i), times.size());
    const double at_first = first.q[i] - nodes[0];
    const double at_last = last.q[i] - nodes[times.size() - 1];
    nodes.array() += at_first + (at_last - at_first) * times.array();
  }
  write_end(first, 0, 0.0, -1.0, x, equality_values);
  write_end(last, program_.blocks().intervals(), program_.guessed_horizon(), 1.0, x, equality_values);
}

void ClampedEnds::write_end(const BoundaryState& end, std::size_t node, double time, double sign, Eigen::VectorXd& x,
                            Eigen::VectorXd& equality_values) {
  const ProgramBlocks& blocks = program_.blocks();
  const UnknownBlock q = blocks.unknown(Quantity::configuration).later(node);
  const UnknownBlock second = blocks.unknown(Quantity::second).later(node);
  const RowBlock momenta = blocks.row(Equation::euler_lagrange).later(node);
  const bool is_velocity = program_.node_state() == NodeState::velocity;
  const Eigen::VectorXd values = is_velocity ? end.v : legendre_.momentum(end.q, end.v, time);
  for (Eigen::Index i = 0; i < end.q.size(); ++i) {
    x[q.index(i)] = end.q[i];
    if (program_.node_state() == NodeState::configuration) {
      equality_values[momenta.index(i)] = sign * values[i];
    } else {
      x[second.index(i)] = values[i];
    }
  }
}

}  // namespace dmocbench
