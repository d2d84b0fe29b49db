#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/run/column.hpp"
#include "bench/run/json_place.hpp"
#include "methods/indirect/indirect_solution.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The indirect solution of a problem, and checks of it.
struct CheckedIndirectSolution {
  std::string problem;            ///< its name
  IndirectSolution solution;      ///< the certified answer
  std::optional<double> seconds;  ///< empty if the solution was read from a file
  double replay_error = 0.0;      ///< distance from the final state at which a replay ends
  double shooting_defect = 0.0;   ///< largest jump between neighbouring intervals that are integrated alone
  std::vector<std::pair<std::string, double>> initial_costate;  ///< with the names of their columns
};

/// Indirect solutions that errors are measured against, one per problem, kept in the output folder.
///
/// PROBLEM_indirect.json holds all numbers of a solution. It is used again if it was made with the same parameters, its
/// checksum holds, its numbers still solve the boundary value problem (so that a changed formula is noticed) and it is
/// on the branch of the direct solution; otherwise the problem is solved again and the file rewritten.
class IndirectReference {
 public:
  /// `folder` is where the files are; it exists when `near` is called.
  explicit IndirectReference(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The solution near a direct one. Throws `Error` if no solution is found (see `solve_indirect`) or the problem's
  /// reference is on another branch.
  [[nodiscard]] const IndirectSolution& near(const Problem& problem, const Trajectory& direct);

  /// All that table, metadata and notes are made of, an object per problem, and the same found by other parts of a run.
  [[nodiscard]] nlohmann::ordered_json findings() const;
  /// Adds the findings of another part. Throws `Error` if they do not have the form that `findings` returns.
  void add_findings(const JsonPlace& findings);

  /// A row per requested problem; the last columns are the costate at t = 0, psi_q_NAME and psi_p_NAME of
  /// every configuration.
  [[nodiscard]] Table table() const;
  /// The same for metadata: an array with an object per problem.
  [[nodiscard]] nlohmann::ordered_json metadata() const;
  /// A sentence for every problem whose reference is certified to fewer than 11 digits, or could not be written.
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> notes_;                        // on files that cannot be written
  std::map<std::string, CheckedIndirectSolution> known_;  // by problem
  std::map<std::string, nlohmann::ordered_json> joined_;  // findings of parts, by problem
};

}  // namespace dmocbench
