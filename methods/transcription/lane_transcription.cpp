#include "methods/transcription/lane_transcription.hpp"

#include <utility>

#include "methods/error.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/transcription/derivatives/column_assembly.hpp"
#include "methods/transcription/derivatives/local_functions.hpp"
#include "methods/transcription/derivatives/part_places.hpp"

namespace dmocbench {

namespace {

Eigen::VectorXd each_for_all_lanes(const Eigen::VectorXd& values) {
  return values.transpose().replicate(instance_lanes, 1).reshaped();
}

Eigen::Map<Eigen::VectorXd> map(double* first, Eigen::Index size) {
  return {first, size * static_cast<Eigen::Index>(instance_lanes)};
}

}  // namespace

/// `ProgramPart` on interleaved vectors: eight times as many intervals, everything else eight times as far apart.
class LaneTranscription::Part {
 public:
  Part(const Transcription& program, const LocalFunctions& functions, const std::vector<ColumnPlace>& unknowns,
       const std::vector<ColumnPlace>& rows, bool has_ends_only)
      : intervals_(has_ends_only ? 1 : program.layout().intervals()),
        mode_(has_ends_only ? AssemblyMode::part : AssemblyMode::whole),
        numbers_(functions.inputs),
        unknowns_(heads(unknowns)),
        rows_(heads(rows)),
        inputs_(functions.inputs.count()),
        cost_(functions.cost, plan({{0}}, intervals_, AssemblyMode::whole)),
        constraints_(functions.rows.schedule,
                     plan(picked(rows, functions.rows.places), program.constraint_count(), mode_)),
        gradient_(functions.gradient.schedule,
                  plan(picked(unknowns, functions.gradient.places), program.variable_count(), mode_)),
        jacobian_(functions.jacobian.schedule,
                  plan(places_in(program.jacobian_structure(), functions.jacobian, rows, unknowns, false),
                       program.jacobian_structure().size(), mode_)),
        hessian_(functions.hessian.schedule,
                 plan(places_in(program.hessian_structure(), functions.hessian, unknowns, unknowns, true),
                      program.hessian_structure().size(), mode_)),
        costs_(static_cast<Eigen::Index>(intervals_ * instance_lanes)) {
    for (std::size_t i = 0; i < numbers_.parameters; ++i) {
      inputs_[i] = {parameters_.emplace_back(costs_.size()).data(), false};
    }
  }

  /// The value of an open parameter in a lane.
  void set_parameter(std::size_t lane, std::size_t number, double value) {
    for (std::size_t k = 0; k < intervals_; ++k) {
      parameters_[number][static_cast<Eigen::Index>(k * instance_lanes + lane)] = value;
    }
  }

  void give_times(const Eigen::VectorXd& steps, const Eigen::VectorXd& times) {
    inputs_[numbers_.step()] = {steps.data(), false};
    inputs_[numbers_.time()] = {times.data(), false};
    inputs_[numbers_.objective_factor()] = {&one_, true};
  }

  void add_objective(const double* x, double* result) {
    cost_.evaluate(bind(x), costs_);
    std::array<double, instance_lanes> sums{};
    lane_loops().sum(costs_.data(), static_cast<std::ptrdiff_t>(intervals_), sums.data());
    for (std::size_t lane = 0; lane < instance_lanes; ++lane) result[lane] += sums[lane];
  }
  void constraints(const double* x, const VectorOut& result) { constraints_.evaluate(bind(x), result); }
  void gradient(const double* x, const VectorOut& result) { gradient_.evaluate(bind(x), result); }
  void jacobian(const double* x, const VectorOut& values) { jacobian_.evaluate(bind(x), values); }
  void hessian(const double* x, const double* multipliers, const VectorOut& values) {
    for (std::size_t r = 0; r < numbers_.rows; ++r) inputs_[numbers_.multiplier(r)] = {multipliers + rows_[r], false};
    hessian_.evaluate(bind(x), values);
  }

 private:
  static std::vector<std::size_t> heads(const std::vector<ColumnPlace>& places) {
    std::vector<std::size_t> heads;
    heads.reserve(places.size());
    for (const ColumnPlace& place : places) heads.push_back(place.first * instance_lanes);
    return heads;
  }
  [[nodiscard]] AssemblyPlan plan(std::vector<ColumnPlace> places, std::size_t size, AssemblyMode mode) const {
    for (ColumnPlace& place : places) place.first *= instance_lanes;
    return {.places = std::move(places),
            .size = size * instance_lanes,
            .intervals = intervals_ * instance_lanes,
            .mode = mode};
  }
  /// Where the local entries of interval 0 stand in the program's matrix.
  static std::vector<ColumnPlace> places_in(const BlockPattern& pattern, const LocalMatrix& matrix,
                                            const std::vector<ColumnPlace>& rows,
                                            const std::vector<ColumnPlace>& columns, bool lower_triangle) {
    std::vector<ColumnPlace> places;
    for (std::size_t e = 0; e < matrix.rows.size(); ++e) {
      std::size_t row = rows[matrix.rows[e]].first;
      std::size_t column = columns[matrix.columns[e]].first;
      if (lower_triangle && row < column) std::swap(row, column);
      const auto found = pattern.find(row, column);
      if (!found) throw Error("an entry of an interval is not in the program's matrix");
      places.emplace_back(*found);
    }
    return places;
  }
  std::span<const Tape::Input> bind(const double* x) {
    for (std::size_t a = 0; a < numbers_.unknowns; ++a) inputs_[numbers_.unknown(a)] = {x + unknowns_[a], false};
    return inputs_;
  }

  std::size_t intervals_;
  AssemblyMode mode_;
  LocalInputs numbers_;
  std::vector<std::size_t> unknowns_;
  std::vector<std::size_t> rows_;
  std::vector<Tape::Input> inputs_;
  AssembledTape cost_;
  AssembledTape constraints_;
  AssembledTape gradient_;
  AssembledTape jacobian_;
  AssembledTape hessian_;
  Eigen::VectorXd costs_;                    // per interval
  std::vector<Eigen::VectorXd> parameters_;  // per open parameter: one value per interval and lane
  double one_ = 1.0;
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
  if (program.has_free_horizon()) throw Error("a batch needs a given horizon; that of this problem is free");
  const Layout& layout = program.layout();
  parts_.push_back(
      std::make_unique<Part>(program, program.functions(), layout.unknown_places(), layout.row_places(), false));
  if (const auto& ends = program.end_functions()) {
    parts_.push_back(
        std::make_unique<Part>(program, *ends, layout.end_unknown_places(), layout.end_row_places(), true));
  }
  for (const auto& part : parts_) part->give_times(steps_, times_);
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
  for (std::size_t i = 0; i < open.size(); ++i) {
    for (const auto& part : parts_) part->set_parameter(lane, i, all[static_cast<Eigen::Index>(open[i])]);
  }
  const auto lanes = static_cast<Eigen::Index>(instance_lanes);
  const auto at = static_cast<Eigen::Index>(lane);
  const auto of_lane = Eigen::seqN(at, program_.grid().relative_widths().size(), lanes);
  steps_(of_lane) = horizon * program_.grid().relative_widths();
  times_(Eigen::seqN(at, program_.grid().relative_times().size(), lanes)) = horizon * program_.grid().relative_times();
}

/// The horizon of the problem with these parameters, whose bounds must be those of the program.
double LaneTranscription::checked_horizon(const Eigen::VectorXd& parameters) const {
  const Problem& problem = program_.problem();
  for (Eigen::Index i = 0; i < parameters.size(); ++i) {
    if (parameters[i] == usual_parameters_[i] ||
        !program_.traced_problem().are_constants()[static_cast<std::size_t>(i)]) {
      continue;
    }
    throw Error("the formulas contain the parameter " + problem.parameters()[static_cast<std::size_t>(i)].name +
                "; to change it, keep it open when the transcription is made");
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
  if (!are_same(usual.q, now.q) || !are_same(usual.v, now.v) || !are_same(usual.u, now.u)) {
    throw Error("the parameters of an instance change bounds, which are the same for a whole batch");
  }
  return horizon;
}

LaneTranscription::~LaneTranscription() = default;

void LaneTranscription::objective(const double* x, double* result) {
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) result[lane] = 0.0;
  for (const auto& part : parts_) part->add_objective(x, result);
}

void LaneTranscription::gradient(const double* x, double* result) {
  for (const auto& part : parts_) part->gradient(x, map(result, variables_));
}

void LaneTranscription::constraints(const double* x, double* result) {
  for (const auto& part : parts_) part->constraints(x, map(result, rows_));
}

void LaneTranscription::jacobian(const double* x, double* values) {
  for (const auto& part : parts_) part->jacobian(x, map(values, jacobian_entries_));
}

void LaneTranscription::hessian(const double* x, const double* multipliers, double* values) {
  for (const auto& part : parts_) part->hessian(x, multipliers, map(values, hessian_entries_));
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
    throw Error("the ends of this problem are not clamped: a batch cannot give every instance its own");
  }
}

void ClampedEnds::write(const BoundaryState& first, const BoundaryState& last, Eigen::VectorXd& x,
                        Eigen::VectorXd& rows) {
  const Eigen::VectorXd& times = program_.grid().relative_times();
  for (Eigen::Index i = 0; i < first.q.size(); ++i) {
    auto nodes = x.segment(static_cast<Eigen::Index>(program_.layout().configuration_column(i)), times.size());
    const double at_first = first.q[i] - nodes[0];
    const double at_last = last.q[i] - nodes[times.size() - 1];
    nodes.array() += at_first + (at_last - at_first) * times.array();
  }
  write_end(first, 0, 0.0, -1.0, x, rows);
  write_end(last, program_.layout().intervals(), program_.guessed_horizon(), 1.0, x, rows);
}

void ClampedEnds::write_end(const BoundaryState& end, std::size_t node, double time, double sign, Eigen::VectorXd& x,
                            Eigen::VectorXd& rows) {
  const Layout& layout = program_.layout();
  const auto entry = [&](std::size_t head) { return static_cast<Eigen::Index>(head + node); };
  const bool is_velocity = layout.node_state() == NodeState::velocity;
  const Eigen::VectorXd second = is_velocity ? end.v : legendre_.momentum(end.q, end.v, time);
  for (Eigen::Index i = 0; i < end.q.size(); ++i) {
    x[entry(layout.configuration_column(i))] = end.q[i];
    if (layout.node_state() == NodeState::configuration) {
      rows[entry(layout.node_row_column(i))] = sign * second[i];
    } else {
      x[entry(layout.second_column(i))] = second[i];
    }
  }
}

}  // namespace dmocbench
