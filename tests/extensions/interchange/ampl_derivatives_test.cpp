// What AMPL's library of solvers reads from the files that we write: every value and derivative, by its own way of
// differentiating, against ours.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "methods/expression/replay.hpp"
#include "methods/extensions/interchange/ampl_model.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/expression/terms.hpp"
#include "tests/extensions/interchange/asl_program.hpp"
#include "tests/extensions/interchange/path_sums.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dmocbench {
namespace {

using tests::AslProgram;
using tests::AslReader;
using tests::PathSums;
using tests::RandomPoints;
using tests::Scheme;
using tests::SparseEntries;
using tests::Terms;

/// The sum of the absolute terms of every number that a program computes.
struct Magnitudes {
  double objective = 0.0;
  Eigen::VectorXd gradient;
  Eigen::VectorXd constraints;
  SparseEntries jacobian;
  SparseEntries hessian;
};

/// Where a program is evaluated.
struct ProgramPoint {
  Eigen::VectorXd x;
  double factor = 0.7;
  Eigen::VectorXd multipliers;
};

/// The sums of a part: of the terms of our formulas, and over all paths through the undifferentiated ones, whose sum
/// every way of differentiating computes.
void add_part(const Transcription& program, const LocalFunctions& functions, const std::vector<SeriesPlace>& unknowns,
              const std::vector<SeriesPlace>& rows, std::size_t k, const ProgramPoint& point, Magnitudes& sums) {
  const LocalInputs& numbers = functions.inputs;
  const auto interval = static_cast<Eigen::Index>(k);
  const auto unknown = [&](std::size_t a) { return static_cast<Eigen::Index>(unknowns[a].at(k)); };
  const auto row = [&](std::size_t r) { return static_cast<Eigen::Index>(rows[r].at(k)); };
  const auto fill = [&](auto& inputs) {
    inputs.resize(numbers.count());
    for (std::size_t a = 0; a < numbers.unknowns; ++a) inputs[numbers.unknown(a)] = point.x[unknown(a)];
    inputs[numbers.step()] = program.step_inputs()[interval];
    inputs[numbers.time()] = program.time_inputs()[interval];
    inputs[numbers.objective_factor()] = point.factor;
    for (std::size_t r = 0; r < numbers.rows; ++r) inputs[numbers.multiplier(r)] = point.multipliers[row(r)];
  };
  std::vector<Terms> values;
  fill(values);
  const std::span<const Terms> given(values);
  sums.objective += replay<Terms>(functions.cost, given)[0].magnitude;

  const auto add_vector = [&](const LocalVector& vector, const auto& place, Eigen::VectorXd& result) {
    const std::vector<Terms> entries = replay<Terms>(vector.schedule, given);
    for (std::size_t e = 0; e < entries.size(); ++e) result[place(vector.places[e])] += entries[e].magnitude;
  };
  const auto add_matrix = [&](const LocalMatrix& matrix, const auto& place, SparseEntries& result) {
    const std::vector<Terms> entries = replay<Terms>(matrix.schedule, given);
    for (std::size_t e = 0; e < entries.size(); ++e) {
      result[place(matrix.rows[e], matrix.columns[e])] += entries[e].magnitude;
    }
  };
  const auto in_jacobian = [&](std::size_t r, std::size_t a) { return std::pair(row(r), unknown(a)); };
  const auto in_hessian = [&](std::size_t a, std::size_t b) {
    return std::pair(std::max(unknown(a), unknown(b)), std::min(unknown(a), unknown(b)));
  };
  add_vector(functions.rows, row, sums.constraints);
  add_vector(functions.gradient, unknown, sums.gradient);
  add_matrix(functions.jacobian, in_jacobian, sums.jacobian);
  add_matrix(functions.hessian, in_hessian, sums.hessian);

  std::vector<PathSums> inputs;
  fill(inputs);
  const std::span<const PathSums> seeded(inputs);
  for (std::size_t a = 0; a < numbers.unknowns; ++a) {
    inputs[numbers.unknown(a)].first = 1.0;
    sums.gradient[unknown(a)] += replay<PathSums>(functions.cost, seeded)[0].first;
    const std::vector<PathSums> slopes = replay<PathSums>(functions.rows.schedule, seeded);
    for (std::size_t e = 0; e < slopes.size(); ++e) {
      sums.jacobian[in_jacobian(functions.rows.places[e], a)] += slopes[e].first;
    }
    for (std::size_t b = 0; b <= a; ++b) {
      inputs[numbers.unknown(b)].second = 1.0;
      const double both = replay<PathSums>(functions.lagrangian, seeded)[0].both;
      sums.hessian[in_hessian(a, b)] += both;
      inputs[numbers.unknown(b)].second = 0.0;
    }
    inputs[numbers.unknown(a)].first = 0.0;
  }
}

Magnitudes magnitudes(const Transcription& program, const ProgramPoint& point) {
  Magnitudes sums;
  sums.gradient.setZero(point.x.size());
  sums.constraints.setZero(point.multipliers.size());
  const ProgramBlocks& blocks = program.blocks();
  for (std::size_t k = 0; k < blocks.intervals(); ++k) {
    add_part(program, program.functions(), blocks.unknown_places(), blocks.row_places(), k, point, sums);
  }
  if (const std::optional<EndFunctions>& ends = program.end_functions()) {
    add_part(program, *ends, blocks.end_unknown_places(), blocks.end_row_places(), 0, point, sums);
  }
  return sums;
}

SparseEntries entries(const BlockPattern& pattern, const Eigen::VectorXd& values) {
  SparseEntries result;
  pattern.for_each([&](Eigen::Index e, int row, int column) { result[{row, column}] += values[e]; });
  return result;
}

/// The largest difference of two numbers, relative to the sum of the absolute terms.
class LargestDifference {
 public:
  void note(const std::string& what, double ours, double theirs, double magnitude) {
    if (ours == theirs) return;  // also where both sums are 0
    const double share = std::abs(ours - theirs) / magnitude;
    if (share <= largest_) return;
    largest_ = share;
    place_ = fmt::format("{}: {} here, {} there, absolute terms {}", what, ours, theirs, magnitude);
  }
  void note(const char* what, const Eigen::VectorXd& ours, const Eigen::VectorXd& theirs,
            const Eigen::VectorXd& magnitudes) {
    ASSERT_EQ(ours.size(), theirs.size());
    for (Eigen::Index i = 0; i < ours.size(); ++i) {
      note(fmt::format("{}[{}]", what, i), ours[i], theirs[i], magnitudes[i]);
    }
  }
  /// An entry that only one side has is 0 on the other. Entries whose terms are rounding beside the largest of the
  /// matrix, as what Newton steps inside of a formula leave, are judged by that rounding.
  void note(const char* what, const SparseEntries& ours, const SparseEntries& theirs, SparseEntries magnitudes) {
    const auto value = [](const SparseEntries& of, const auto& place) {
      const auto entry = of.find(place);
      return entry == of.end() ? 0.0 : entry->second;
    };
    double largest = 0.0;
    for (const auto& [place, magnitude] : magnitudes) largest = std::max(largest, magnitude);
    SparseEntries all = ours;
    all.insert(theirs.begin(), theirs.end());
    for (const auto& [place, number] : all) {
      note(fmt::format("{}[{}, {}]", what, place.first, place.second), value(ours, place), value(theirs, place),
           magnitudes[place] + std::numeric_limits<double>::epsilon() * largest);
    }
  }
  void note(const LargestDifference& other) {
    if (!(other.largest_ <= largest_)) *this = other;
  }
  [[nodiscard]] double value() const { return largest_; }
  /// Where it is.
  [[nodiscard]] const std::string& place() const { return place_; }

 private:
  double largest_ = 0.0;
  std::string place_;
};

/// A point near the guess where every row is a number; nothing where there is none (a step that is too long for
/// shooting).
std::optional<ProgramPoint> point_near_guess(Transcription& program, const Eigen::VectorXd& start,
                                             RandomPoints& random) {
  ProgramPoint point{.x = {}, .multipliers = random.vector(static_cast<Eigen::Index>(program.constraint_count()))};
  const Eigen::VectorXd direction = random.vector(start.size()).cwiseProduct(start.cwiseAbs().cwiseMax(0.1));
  Eigen::VectorXd rows(point.multipliers.size());
  for (double spread = 0.02; spread > 1e-6; spread /= 4.0) {
    point.x = start + spread * direction;
    program.constraints(point.x, rows);
    if (rows.allFinite()) return point;
  }
  return std::nullopt;
}

/// The smaller of the two differences from the library's two ways to differentiate twice.
///
/// Each of them errs on some programs whose defined variables read others (by its own first derivatives, of which it
/// is not the derivative), never both on one program. An agreement to the last digits is no accident.
LargestDifference difference_of_hessians(const SparseEntries& ours, const std::array<const AslProgram*, 2>& readers,
                                         const ProgramPoint& point, const SparseEntries& magnitudes) {
  std::array<LargestDifference, 2> differences;
  for (std::size_t i = 0; i < readers.size(); ++i) {
    differences[i].note("hessian", ours, readers[i]->hessian(point.x, point.factor, point.multipliers), magnitudes);
  }
  return differences[0].value() <= differences[1].value() ? differences[0] : differences[1];
}

/// Writes the program, lets the library read it, and compares all at random points near the guess; nothing where there
/// are none.
std::optional<LargestDifference> largest_difference(Transcription& program, const std::filesystem::path& folder) {
  const Eigen::VectorXd start = sample(program, guessed_motion(program.problem()));
  const AmplModel model = ampl_model(program, start);
  std::ofstream(folder / "model.nl") << model.nl;
  std::ofstream(folder / "model.row") << model.row;
  std::ofstream(folder / "model.col") << model.col;
  const AslProgram theirs(folder / "model.nl", AslReader::whole);
  const AslProgram by_parts(folder / "model.nl", AslReader::partially_separable);
  EXPECT_EQ(theirs.start, start);
  EXPECT_EQ(theirs.variable_lower, program.variable_lower());
  EXPECT_EQ(theirs.variable_upper, program.variable_upper());
  EXPECT_EQ(theirs.row_lower, program.constraint_lower());
  EXPECT_EQ(theirs.row_upper, program.constraint_upper());
  RandomPoints random;
  LargestDifference difference;
  for (int repeat = 0; repeat < 2; ++repeat) {
    const std::optional<ProgramPoint> found = point_near_guess(program, start, random);
    if (!found) return std::nullopt;
    const ProgramPoint& point = *found;
    const Magnitudes sums = magnitudes(program, point);
    Eigen::VectorXd gradient(start.size());
    Eigen::VectorXd rows(point.multipliers.size());
    Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program.jacobian_structure().size()));
    Eigen::VectorXd hessian(static_cast<Eigen::Index>(program.hessian_structure().size()));
    program.gradient(point.x, gradient);
    program.constraints(point.x, rows);
    program.jacobian(point.x, jacobian);
    program.hessian(point.x, point.factor, point.multipliers, hessian);
    difference.note("objective", program.objective(point.x), theirs.objective(point.x), sums.objective);
    difference.note("gradient", gradient, theirs.gradient(point.x), sums.gradient);
    difference.note("rows", rows, theirs.constraints(point.x), sums.constraints);
    difference.note("jacobian", entries(program.jacobian_structure(), jacobian), theirs.jacobian(point.x),
                    sums.jacobian);
    difference.note(difference_of_hessians(entries(program.hessian_structure(), hessian), {&theirs, &by_parts}, point,
                                           sums.hessian));
  }
  return difference;
}

struct Written {
  std::string problem;
  Scheme scheme;
  CostForm form = CostForm::bolza;
};

/// The variable names one problem, or has another value for all.
bool problem_is_left_out(const char* only, const std::string& problem) {
  const std::vector<std::string> names = problem_names();
  return std::ranges::find(names, only) != names.end() && problem != only;
}

bool all_are_asked_for() { return std::getenv("DMOCBENCH_ALL_PROGRAMS") != nullptr; }

/// On few intervals, or as many as the problem needs.
std::unique_ptr<Transcription> transcribed(const Problem& problem, const Written& written) {
  for (const Eigen::Index intervals : {6, 12, 24}) {
    try {
      return std::make_unique<Transcription>(problem, *make_element(written.scheme.method), written.scheme.tableau(),
                                             tests::graded_grid(intervals), "tape", written.form);
    } catch (const Error&) {  // fewer free variables than rows
    }
  }
  return nullptr;
}

void expect_agreement(const Written& written, const std::filesystem::path& folder) {
  const auto problem = make_problem(written.problem);
  if (!tests::takes_constraints(*problem, written.scheme)) return;
  const std::string label =
      fmt::format("{} {}{}", written.problem, written.scheme.label(), written.form == CostForm::mayer ? " mayer" : "");
  const auto program = transcribed(*problem, written);
  ASSERT_NE(program, nullptr) << label;
  const std::optional<LargestDifference> difference = largest_difference(*program, folder);
  if (!difference) {
    fmt::print("{}: no number near the guess\n", label);
    return;
  }
  EXPECT_LE(difference->value(), 1e-13) << label << ", " << difference->place();
  if (all_are_asked_for()) fmt::print("{}: {:.1e}\n", label, difference->value());
}

using AmplDerivatives = tests::InTemporaryFolder;

TEST_F(AmplDerivatives, AreOursInASampleOfAllPrograms) {
  expect_agreement({"orbital_transfer", {"dmoc"}}, folder());
  expect_agreement({"two_link_manipulator", {"hamiltonian", 2}}, folder());
  expect_agreement({"brachistochrone", {"tangent", 2}}, folder());
  expect_agreement({"planar_quadrotor", {"dmoc", 2, "lobatto"}}, folder());
  expect_agreement({"hang_glider", {"multiple_shooting_rk4_1"}}, folder());
  expect_agreement({"cart_pole", {"dmoc"}, CostForm::mayer}, folder());
  expect_agreement({"cart_pole_cartesian", {"hamiltonian"}}, folder());
}

TEST_F(AmplDerivatives, AreOursInAllProgramsIfAllAreAskedFor) {
  if (!all_are_asked_for()) GTEST_SKIP() << "tests/extensions/interchange/agrees_with_ampl asks";
  const char* const only = std::getenv("DMOCBENCH_ALL_PROGRAMS");
  for (const std::string& problem : problem_names()) {
    if (problem_is_left_out(only, problem)) continue;
    for (const std::string& method : all_methods()) {
      if (family_of(method).is_condensed) continue;  // the program of multiple shooting
      const bool has_first_order = make_problem(problem)->first_order_size() > 0;
      if (has_first_order && !family_of(method).is_of_paper) continue;  // shooting does not know them
      for (const int stages : {1, 2, 3}) {
        expect_agreement({problem, {method, stages}}, folder());
        expect_agreement({problem, {method, stages}, CostForm::mayer}, folder());
        if (stages > 1) expect_agreement({problem, {method, stages, "lobatto"}}, folder());
      }
    }
  }
}

}  // namespace
}  // namespace dmocbench
