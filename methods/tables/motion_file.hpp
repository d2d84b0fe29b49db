#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "methods/mechanics/column_names.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/tables/table.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

// Of phases, every table below holds the rows of phase after phase, in the time of the whole motion and
// the phase's own velocities, with the column `phase` next to the time and an empty field where a phase lacks a
// quantity. A switch has a row of each side.

/// The nodes of a trajectory: `t`, then per configuration NAME, `v_NAME`, `p_NAME`, and `psi_q_NAME`, `psi_p_NAME`
/// where there are costates (empty fields otherwise), and `price_NAME`, `price_v_NAME` where there are bounds
/// (`BoundMultipliers`). Unknown parameters by their names, `integral_1` and so on, and the prices of their bounds and
/// of T's (`price_horizon`) are the same in all rows. Units of the problem as solved.
[[nodiscard]] Table node_table(const Problem& problem, const Trajectory& trajectory);

/// The stages: `t` and the controls by their names; with constraints g(q) = 0 `lambda_1` to `lambda_c`, the multipliers
/// of the equations of motion at the stages, so that -Gᵀλ is the force of constraint; `price_NAME` of their bounds and
/// of path constraints, `price_v_NAME` of velocities, where there are any.
[[nodiscard]] Table stage_table(const Problem& problem, const Trajectory& trajectory);

/// The data of a picture, at the nodes: `t` in the problem's unit of time, then the quantities of
/// `ProblemCard::picture`, each named by `name_with_unit`. The control at a node comes from `control_at`.
[[nodiscard]] Table picture_table(const Problem& problem, const Trajectory& trajectory);

/// The path constraints at the nodes: `t` as in `node_table` and h by the names of
/// `ProblemCard::path_constraint_names`, h_1, h_2, ... where there are none. Without columns if there are no
/// constraints.
[[nodiscard]] Table constraint_table(const Problem& problem, const Trajectory& trajectory);

/// The contents of a figure of the motion: a row for t and for each q, u and path constraint with `kind` (t, q, u or
/// h), `quantity` (its column), `unit`, and its bounds `lower` and `upper`, empty where there are none. Bounds of q at
/// a time between the ends have rows of their own, with `time`, the share of T.
[[nodiscard]] Table quantity_table(const Problem& problem);

/// Writes a motion: its nodes to X_nodes.csv, the file that is named, and its stages to X_stages.csv next to it. Throws
/// `Error` if the name has another ending or a file cannot be written.
void write_motion(const Problem& problem, const Trajectory& trajectory, const std::filesystem::path& nodes_file);

/// The stage table of a node table: X_stages.csv for X_nodes.csv. Throws `Error` if the name has another ending.
[[nodiscard]] std::filesystem::path stages_file_of(const std::filesystem::path& nodes_file);

/// Whether a file is one of the two that hold the motion of this node table.
[[nodiscard]] bool is_file_of_motion(const std::filesystem::path& file, const std::string& nodes_file);

/// The texts of the files of a motion.
struct MotionTexts {
  std::string nodes;        ///< of the file
  std::string stages = {};  ///< of X_stages.csv next to it; empty if there is none
};
/// Reads them. Throws `Error` that names the file that cannot be read.
[[nodiscard]] MotionTexts read_motion_texts(const std::filesystem::path& file);

/// Reads a motion from a table of the columns `t`, NAME and `v_NAME` per configuration, with costates where it has a
/// number for every one of them (`node_table`). The controls are read from X_stages.csv next to a file X_nodes.csv if
/// it exists, else from the file's columns with their names, else taken from the guess. Throws `Error` that names the
/// file and the missing columns, or if the two tables are not of one motion from t = 0 on, or if it lasts more than ten
/// times as long as the problem's, or less than a tenth of it.
[[nodiscard]] Trajectory read_motion_tables(const Problem& problem, const std::filesystem::path& file);
/// The same of files that were read before.
[[nodiscard]] Trajectory motion_in_texts(const Problem& problem, const MotionTexts& texts,
                                         const std::filesystem::path& file);

}  // namespace dmocbench
