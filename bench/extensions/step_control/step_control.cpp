// Step sizes that are tied to the motion: inside the variational principle and outside of it (section 5, KMLTMD).
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "bench/experiments/invariants/long_time_energy.hpp"
#include "bench/extensions/step_control/controlled_steps.hpp"
#include "bench/extensions/step_control/optimal_steps.hpp"
#include "bench/run/column.hpp"
#include "bench/run/table_run.hpp"
#include "methods/diagnostics/convergence_order.hpp"

namespace dmocbench::step_control_program {

/// The measurements of a choice of steps along an ellipse.
template <class Result>
struct OnEllipse {
  StepChoice choice;
  double eccentricity = 0.0;
  int steps = 0;  ///< per period, or of the whole motion
  long long periods = 0;
  Result result;
};

using Symplecticity = OnEllipse<ControlledSteps::Symplecticity>;
using Momentum = OnEllipse<ControlledSteps::Momentum>;
using EnergyOfPeriod = OnEllipse<PeriodEnergy>;
using EnergyOfPeriods = OnEllipse<EnergyBehaviour>;
using PeriodError = OnEllipse<std::optional<ControlledSteps::PeriodError>>;  // none where a step has no solution
struct Order {
  FittedOrder fit;
  std::size_t operations = 0;
};
using ErrorOrder = OnEllipse<Order>;

/// The eccentricity as given, without the digits of its rounding.
template <class Record>
FieldReader<Record> eccentricity_of() {
  return {[](const Record& row) { return Cell(fmt::format("{:g}", row.eccentricity)); },
          FieldType{FieldKind::number, false}};
}

template <class Record>
Columns<Record> choice_columns() {
  return {{"problem", "", "name of the problem", [](const Record& /*row*/) { return "kepler"; }, in_key},
          {"eccentricity", "", "eccentricity of the ellipse", eccentricity_of<Record>(), in_key},
          {"rule", "",
           "step sizes: uniform; h = pace * sigma, as part of the principle (variational) or imposed on plain DMOC "
           "(imposed); or h = pace * sigma(q_k), computed before the step (from_left)",
           from(&Record::choice, &StepChoice::rule_name), in_key},
          {"sigma", "", "quantity on which the step function depends", from(&Record::choice, &StepChoice::sigma_name),
           in_key},
          {"stages", "", "number of Gauss stages", from(&Record::choice, &StepChoice::stages), in_key}};
}
template <class Record>
Column<Record> steps_per_period(bool is_key = false) {
  return {"steps_per_period", "", "number of steps in a period of the unforced trajectory", &Record::steps, is_key};
}

const Columns<Symplecticity> symplecticity_columns =
    choice_columns<Symplecticity>() +
    Columns<Symplecticity>{steps_per_period<Symplecticity>(),
                           {"defect", "", "largest entry of D^T Omega D - Omega for D of (q, t, p, -E) over a period",
                            from(&Symplecticity::result, &ControlledSteps::Symplecticity::defect)},
                           {"rounding", "", "machine epsilon times the largest square of an entry of D",
                            from(&Symplecticity::result, &ControlledSteps::Symplecticity::rounding)}};

const Columns<Momentum> momentum_columns =
    choice_columns<Momentum>() +
    Columns<Momentum>{{"number_of_steps", "", "number of steps under an arbitrary thrust", &Momentum::steps},
                      {"momentum_change", "", "J_N - J_0", from(&Momentum::result, &ControlledSteps::Momentum::change)},
                      {"work", "", "sum of h b_i f·xi", from(&Momentum::result, &ControlledSteps::Momentum::work)},
                      {"defect", "", "max over k of |J_k - J_0 - work|",
                       from(&Momentum::result, &ControlledSteps::Momentum::defect)}};

const Columns<EnergyOfPeriod> energy_columns = choice_columns<EnergyOfPeriod>() +
                                               Columns<EnergyOfPeriod>{steps_per_period<EnergyOfPeriod>(in_key)} +
                                               period_energy_columns(&EnergyOfPeriod::result);

const Columns<EnergyOfPeriods> behaviour_columns =
    choice_columns<EnergyOfPeriods>() +
    Columns<EnergyOfPeriods>{steps_per_period<EnergyOfPeriods>(),
                             {"periods", "", "number of periods", &EnergyOfPeriods::periods}} +
    energy_behaviour_columns(&EnergyOfPeriods::result);

constexpr auto period_error = &PeriodError::result;
const Columns<PeriodError> error_columns =
    choice_columns<PeriodError>() +
    Columns<PeriodError>{
        steps_per_period<PeriodError>(in_key),
        {"status", "", "solved, or step failed if a step is so large that its equations have no solution",
         [](const PeriodError& row) { return row.result ? "solved" : "step failed"; }},
        {"state_error", "", "max over a period of |(q, v) - exact|, with each node at its own time",
         from(period_error, &ControlledSteps::PeriodError::state)},
        {"energy_error", "", "max over a period of |E - E_0|",
         from(period_error, &ControlledSteps::PeriodError::energy)},
        {"largest_step", "", "largest h", from(period_error, &ControlledSteps::PeriodError::largest_step)},
        {"smallest_step", "", "smallest h", from(period_error, &ControlledSteps::PeriodError::smallest_step)}};

const Columns<ErrorOrder> order_columns =
    choice_columns<ErrorOrder>() +
    Columns<ErrorOrder>{{"slope", "", "fitted order of the state error over the pace",
                         [](const ErrorOrder& row) { return row.result.fit.order; }},
                        {"standard_error", "", "standard error of the order",
                         [](const ErrorOrder& row) { return row.result.fit.standard_error; }},
                        {"operations", "", "number of operations of one Newton pass over a step",
                         [](const ErrorOrder& row) { return static_cast<long long>(row.result.operations); }}};

/// One solve of the eccentric transfer.
struct Transfer {
  StepChoice choice;
  double eccentricity = 0.0;
  long long intervals = 0;
  double digits = 0.0;
  OptimalSteps solved;
};
constexpr auto solved = &Transfer::solved;
constexpr auto transfer_errors = &OptimalSteps::errors;
const Columns<Transfer> transfer_columns{
    {"problem", "", "name of the problem", [](const Transfer& /*row*/) { return "ellipse_transfer"; }, in_key},
    {"eccentricity", "", "eccentricity of both ellipses", eccentricity_of<Transfer>(), in_key},
    {"rule", "", "uniform; proportional to sigma along the optimum (imposed); or part of the principle (variational)",
     from(&Transfer::choice, &StepChoice::rule_name), in_key},
    {"sigma", "", "quantity on which the step function depends", from(&Transfer::choice, &StepChoice::sigma_name),
     in_key},
    {"stages", "", "number of Gauss stages", from(&Transfer::choice, &StepChoice::stages), in_key},
    {"intervals", "", "number of intervals N", &Transfer::intervals, in_key},
    {"variables", "", "number of variables of the program", from(solved, &OptimalSteps::variables)},
    {"status", "", "status of the solve", from(solved, &OptimalSteps::status)},
    {"reference_digits", "", "number of certified digits of the indirect solution", &Transfer::digits},
    {"cost_error", "", "|J - J*| / J*", from(solved, transfer_errors, &StepsErrors::cost)},
    {"state_error", "", "max over the nodes of |q - q*|, with each node at its own time",
     from(solved, transfer_errors, &StepsErrors::state)},
    {"control_error", "", "max over the stages of |u - u*|", from(solved, transfer_errors, &StepsErrors::control)},
    {"momentum_defect", "",
     "largest difference between the change of angular momentum and the work of the thrust over an interval",
     from(solved, transfer_errors, &StepsErrors::momentum)},
    {"replay_error", "", "distance between the end of the replay and the final state",
     from(solved, transfer_errors, &StepsErrors::replay)}};

/// Uniform steps, and every rule with each of some functions.
std::vector<StepChoice> choices(const std::vector<SigmaReads>& sigmas, const std::vector<int>& stages) {
  std::vector<StepChoice> all;
  for (const int s : stages) {
    all.push_back({.stages = s});
    for (const SigmaReads sigma : sigmas) {
      for (const StepPolicy rule : {StepPolicy::variational, StepPolicy::imposed, StepPolicy::from_left})
        all.push_back({rule, sigma, s});
    }
  }
  return all;
}

std::optional<ControlledSteps::PeriodError> error_if_solved(const ControlledSteps& steps) {
  const auto error = measured_or_reason([&] { return steps.error_of_a_period(); });
  return error ? std::optional(*error) : std::nullopt;
}

class Measurement {
 public:
  Measurement(TableRun& run, double exponent) : run_(run), exponent_(exponent) {}

  void structure(int momentum_steps) {
    constexpr double eccentricity = 0.6;
    constexpr int steps = 64;
    std::vector<Symplecticity> forms;
    std::vector<Momentum> momenta;
    for (const StepChoice& choice :
         choices({SigmaReads::distance, SigmaReads::acceleration, SigmaReads::thrust}, {1, 2})) {
      run_.show(fmt::format("symplectic form and momentum: {} {}", choice.rule_name(), choice.sigma_name()));
      const ControlledSteps controlled(eccentricity, choice, steps, exponent_);
      if (choice.sigma != SigmaReads::thrust)
        forms.push_back({choice, eccentricity, steps, 1, controlled.symplecticity()});
      momenta.push_back({choice, eccentricity, momentum_steps, 0, controlled.momentum(momentum_steps)});
    }
    run_.add("step_control_symplecticity", symplecticity_columns, forms);
    run_.add("step_control_momentum", momentum_columns, momenta);
  }

  void energies(int steps, long long periods) {
    std::vector<EnergyOfPeriod> energies;
    std::vector<EnergyOfPeriods> behaviours;
    for (const double eccentricity : {0.3, 0.6, 0.8}) {
      for (const StepChoice& choice : choices({SigmaReads::distance}, {1})) {
        run_.show(fmt::format("energy over many periods: e = {}, {}", eccentricity, choice.rule_name()));
        const std::vector<PeriodEnergy> watched =
            ControlledSteps(eccentricity, choice, steps, exponent_).energy(periods);
        for (const PeriodEnergy& period : watched) energies.push_back({choice, eccentricity, steps, periods, period});
        behaviours.push_back({choice, eccentricity, steps, periods, energy_behaviour(watched)});
      }
    }
    run_.add("step_control_energy", energy_columns, energies);
    run_.add("step_control_energy_behaviour", behaviour_columns, behaviours);
  }

  void errors() {
    std::vector<PeriodError> errors;
    std::vector<ErrorOrder> orders;
    for (const double eccentricity : {0.3, 0.6, 0.8}) {
      for (const StepChoice& choice : choices({SigmaReads::distance, SigmaReads::acceleration}, {1, 2})) {
        run_.show(fmt::format("errors of a period: e = {}, {}", eccentricity, choice.rule_name()));
        std::vector<GridError> points;
        std::size_t operations = 0;
        for (const int steps : {64, 128, 256, 512}) {
          const ControlledSteps controlled(eccentricity, choice, steps, exponent_);
          errors.push_back({choice, eccentricity, steps, 1, error_if_solved(controlled)});
          if (errors.back().result) points.push_back({1.0 / steps, errors.back().result->state});
          operations = controlled.operations();
        }
        const std::vector<GridError> finest(points.size() > 3 ? points.end() - 3 : points.begin(), points.end());
        if (const auto fit = fit_order(finest); fit && fit->points > 2)
          orders.push_back({choice, eccentricity, 0, 1, {*fit, operations}});
      }
    }
    run_.add("step_control", error_columns, errors);
    run_.add("step_control_slopes", order_columns, orders);
  }

  void transfers() {
    std::vector<Transfer> rows;
    for (const double eccentricity : {0.3, 0.6, 0.8}) {
      run_.show(fmt::format("the optimal transfer between ellipses, e = {}", eccentricity));
      const SteppedTransfer transfer(eccentricity, TableRun::solver_options());
      for (const StepChoice& choice : {StepChoice(), StepChoice{StepPolicy::imposed, SigmaReads::distance},
                                       StepChoice{StepPolicy::variational, SigmaReads::distance}}) {
        for (const long long intervals : {32, 64, 128, 256}) {
          run_.show(fmt::format("transfer between ellipses, e = {}, {} steps, N = {}", eccentricity, choice.rule_name(),
                                intervals));
          rows.push_back(
              {choice, eccentricity, intervals, transfer.digits(),
               transfer.solve(choice.rule, step_function(choice.sigma, exponent_), choice.stages, intervals)});
        }
      }
    }
    run_.add("step_control_transfer", transfer_columns, rows);
  }

 private:
  TableRun& run_;
  double exponent_;
};

int measure_all(CommandLine& line) {
  constexpr double exponent = 1.5;  // of the steps by distance, sigma = |q|^p
  int steps_per_period = 128;
  int steps = 400;
  long long periods = 200;
  line.number("--steps", steps, 1, 1000000, "number of steps under an arbitrary thrust");
  line.number("--steps-per-period", steps_per_period, 32, 100000, "number of steps per period for the energies");
  line.number("--periods", periods, 3, 10000000, "number of periods for the energies");
  TableRun run("step_control", line);
  Measurement measurement(run, exponent);
  measurement.structure(steps);
  measurement.energies(steps_per_period, periods);
  measurement.errors();
  measurement.transfers();
  return run.write();
}

int run(int argc, char** argv) {
  return run_program(
      "step_control",
      "Compares step sizes that are proportional to a function of the trajectory along Kepler ellipses: as a "
      "constraint of the variational principle, imposed on plain DMOC, and computed before each step. Measures the "
      "symplectic form of the extended map (step_control_symplecticity.csv), momentum against work "
      "(step_control_momentum.csv), the energy over many periods (step_control_energy.csv, "
      "step_control_energy_behaviour.csv), errors of a period and of uniform steps (step_control.csv, "
      "step_control_slopes.csv), and the optimal transfer between ellipses (step_control_transfer.csv).",
      argc, argv, measure_all);
}

}  // namespace dmocbench::step_control_program
